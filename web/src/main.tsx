import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { App } from "./App";
import { startLanguage } from "./i18n";
import { findOut } from "./me";
import { startTheme } from "./theme";
import "./theme.css";
import "./styles.css";

const root = document.getElementById("root");
startTheme();
void Promise.all([startLanguage(), findOut()]).then(() => {
  if (root)
    createRoot(root).render(
      <StrictMode>
        <App />
      </StrictMode>,
    );
});

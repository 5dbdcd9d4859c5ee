import { StrictMode } from "react";
import { createRoot } from "react-dom/client";
import { App } from "./App";
import { startLanguage } from "./i18n";
import { startTheme } from "./theme";
import "./theme.css";
import "./styles.css";

const root = document.getElementById("root");
startTheme();
void startLanguage().then(() => {
  if (root)
    createRoot(root).render(
      <StrictMode>
        <App />
      </StrictMode>,
    );
});

// Which page the address names.

import { useEffect } from "react";
import { Header } from "./components/Header";
import { t, useLanguage } from "./i18n";
import { ExperimentsPage } from "./pages/ExperimentsPage";
import { PracticePage } from "./pages/PracticePage";
import { StudiesPage } from "./pages/StudiesPage";
import { StudyPage } from "./pages/StudyPage";
import { TrainerPage } from "./pages/TrainerPage";
import { Link, usePath } from "./router";

export function App() {
  const path = usePath();
  useLanguage(); // a new language draws everything below anew
  const trainer = /^\/experiments\/(\d+)\/?$/.exec(path);
  useEffect(() => {
    if (!trainer) document.title = "SEED";
  }, [trainer]);
  if (trainer) return <TrainerPage key={trainer[1]} id={Number(trainer[1])} />;
  const practice = /^\/experiments\/(\d+)\/practice\/?$/.exec(path);
  if (practice) return <PracticePage key={practice[1]} id={Number(practice[1])} />;
  const study = /^\/studies\/([^/]+)\/?$/.exec(path);
  if (study?.[1]) return <StudyPage key={study[1]} name={decodeURIComponent(study[1])} />;
  if (path === "/studies") return <StudiesPage />;
  if (path === "/" || path === "/experiments") return <ExperimentsPage />;
  return (
    <>
      <Header />
      <main className="page narrow">
        <div className="empty">
          <h1>{t("problem.noPage")}</h1>
          <p>{t("problem.noPageWhat")}</p>
          <Link to="/" className="button primary">
            {t("common.allExperiments")}
          </Link>
        </div>
      </main>
    </>
  );
}

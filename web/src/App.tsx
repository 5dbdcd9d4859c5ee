// Which page the address names. The judging page and the list come at once, the others when they are asked for.

import { type ComponentType, lazy, Suspense, useEffect } from "react";
import { Header } from "./components/Header";
import { StopsElsewhere } from "./components/StopsElsewhere";
import { t, useLanguage } from "./i18n";
import { LOGIN, may, ROLE } from "./me";
import { ExperimentsPage } from "./pages/ExperimentsPage";
import { TrainerPage } from "./pages/TrainerPage";
import { Link, usePath } from "./router";

function later<Props extends object>(load: () => Promise<ComponentType<Props>>) {
  return lazy(async () => ({ default: await load() }));
}

const PracticePage = later(async () => (await import("./pages/PracticePage")).PracticePage);
const StudiesPage = later(async () => (await import("./pages/StudiesPage")).StudiesPage);
const StudyPage = later(async () => (await import("./pages/StudyPage")).StudyPage);
const NewExperimentPage = later(async () => (await import("./pages/NewExperimentPage")).NewExperimentPage);
const ResultsPage = later(async () => (await import("./pages/ResultsPage")).ResultsPage);
const GalleryPage = later(async () => (await import("./pages/GalleryPage")).GalleryPage);
const EpisodePage = later(async () => (await import("./pages/EpisodePage")).EpisodePage);
const CriticPage = later(async () => (await import("./pages/CriticPage")).CriticPage);
const SignInPage = later(async () => (await import("./pages/SignInPage")).SignInPage);
const PeoplePage = later(async () => (await import("./pages/PeoplePage")).PeoplePage);
const CamerasPage = later(async () => (await import("./pages/CamerasPage")).CamerasPage);
const ComparePage = later(async () => (await import("./pages/ComparePage")).ComparePage);

/** What of an address belongs to one experiment, and its page. */
const OF_EXPERIMENT = {
  practice: PracticePage,
  results: ResultsPage,
  gallery: GalleryPage,
  critic: CriticPage,
  cameras: CamerasPage,
} as const;

function Page({ path }: { path: string }) {
  const trainer = /^\/experiments\/(\d+)\/?$/.exec(path);
  useEffect(() => {
    if (!trainer) document.title = "SEED";
  }, [trainer]);
  if (trainer) return <TrainerPage key={trainer[1]} id={Number(trainer[1])} />;
  const part = /^\/experiments\/(\d+)\/(\w+)\/?$/.exec(path);
  const Part = OF_EXPERIMENT[part?.[2] as keyof typeof OF_EXPERIMENT];
  if (part && Part) return <Part key={part[1]} id={Number(part[1])} />;
  const episode = /^\/experiments\/(\d+)\/episodes\/(\d+)\/?$/.exec(path);
  if (episode)
    return (
      <EpisodePage key={`${episode[1]} ${episode[2]}`} id={Number(episode[1])} number={Number(episode[2])} />
    );
  const study = /^\/studies\/([^/]+)\/?$/.exec(path);
  if (study?.[1]) return <StudyPage key={study[1]} name={decodeURIComponent(study[1])} />;
  if (path === "/studies") return <StudiesPage />;
  if (path === "/people" && LOGIN && may("operator")) return <PeoplePage />;
  if (path === "/compare") return <ComparePage />;
  if (path === "/experiments/new") return <NewExperimentPage />;
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

function Coming() {
  return (
    <>
      <Header back />
      <main className="page">
        <div className="skeleton" role="status" aria-label={t("common.loading")} />
      </main>
    </>
  );
}

export function App() {
  const path = usePath();
  useLanguage(); // a new language draws everything below anew
  return (
    <>
      <StopsElsewhere />
      <Suspense fallback={<Coming />}>
        {ROLE === null || path === "/join" ? <SignInPage /> : <Page path={path} />}
      </Suspense>
    </>
  );
}

// Where somebody comes in: by the link of an invitation (/join#token), or by pasting a token.

import { type FormEvent, useEffect, useState } from "react";
import { at } from "../base";
import { Field } from "../components/Field";
import { Sprout } from "../components/icons";
import { Preferences } from "../components/Preferences";
import * as http from "../http";
import { t } from "../i18n";
import { isName, LOGIN } from "../me";
import type { Problem } from "../wire";

/** The token stands behind the # and is taken out of the address at once: it should be in no history and no picture. */
const LINKED = location.hash.slice(1);
if (LINKED) history.replaceState(null, "", location.pathname + location.search);

/** Where they wanted to go; from the link of an invitation, to the experiments. */
const next = (): string => (location.pathname === at("/join") ? at("/") : location.href);

export function SignInPage() {
  const [token, setToken] = useState(LINKED);
  const [name, setName] = useState("");
  const [asksName, setAsksName] = useState(LINKED !== "");
  const [problem, setProblem] = useState<Problem | null>(null);
  const [busy, setBusy] = useState(false);
  useEffect(() => {
    document.title = `${t("people.signIn")} · SEED`;
  }, []);
  const enter = async (event: FormEvent) => {
    event.preventDefault();
    setBusy(true);
    setProblem(null);
    try {
      await http.signIn(token.trim().replace(/^.*#/, ""), name.trim() || null);
      location.replace(next());
    } catch (error) {
      const told = http.problemOf(error);
      if (/^name:/i.test(told.detail)) setAsksName(true);
      setProblem(told);
      setBusy(false);
    }
  };
  const wrong = name.trim() !== "" && !isName(name.trim());
  return (
    <>
      <header className="header">
        <span className="brand">
          <Sprout />
          <span>SEED</span>
        </span>
        <span className="spring" />
        <Preferences />
      </header>
      <main className="page narrow">
        <form className="card sign-in" onSubmit={(event) => void enter(event)}>
          <h1>{t(LINKED ? "people.invited" : "people.signIn")}</h1>
          <p>{t(LOGIN ? (LINKED ? "people.invitedWhat" : "people.signInWhat") : "people.noLogin")}</p>
          {!LINKED && <Field label={t("people.token")} name="token" value={token} onChange={setToken} />}
          {asksName && (
            <Field
              label={t("people.name")}
              name="name"
              value={name}
              hint={t("people.nameWhat")}
              error={wrong ? t("settings.nameWrong") : undefined}
              onChange={setName}
            />
          )}
          {problem && (
            <p className="error" role="alert" data-testid="sign-in-problem">
              {problem.detail} {problem.remedy}
            </p>
          )}
          <button
            type="submit"
            className="button primary"
            disabled={busy || wrong || token.trim() === "" || !LOGIN}
            data-testid="sign-in"
          >
            {t("people.enter")}
          </button>
        </form>
      </main>
    </>
  );
}

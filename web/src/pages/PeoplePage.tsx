// Who may come in: invitations to hand out, people and where they are, and the audit of what they have decided.

import { type FormEvent, useEffect, useState } from "react";
import { Confirm, type Question } from "../components/Dialog";
import { Choice, Field } from "../components/Field";
import { Header } from "../components/Header";
import { ProblemBanner } from "../components/ProblemBanner";
import * as http from "../http";
import { t } from "../i18n";
import { moment } from "../i18n/numbers";
import { ME, may } from "../me";
import { usePolled } from "../usePolled";
import type { Invitation, InvitationMade, Person, Problem, Role } from "../wire";

const REFRESH_MS = 4000;
const ROLES: readonly Role[] = ["viewer", "trainer", "operator", "owner"];
const NUMBER = /^\d+(\.\d+)?$/;

const roleOptions = () => ROLES.filter(may).map((role) => ({ value: role, label: t(`people.role_${role}`) }));

function NewLink({ made }: { made: InvitationMade }) {
  const link = `${location.origin}${made.path}`;
  const [copied, setCopied] = useState(false);
  const copy = () => {
    void navigator.clipboard?.writeText(link).then(() => setCopied(true));
  };
  return (
    <div className="link-made" role="status">
      <p>{t("people.linkOnce")}</p>
      <code className="command" data-testid="link">
        {link}
      </code>
      {navigator.clipboard && (
        <button type="button" className="button" onClick={copy} data-testid="copy-link">
          {t(copied ? "people.copied" : "people.copy")}
        </button>
      )}
    </div>
  );
}

function Invite({ onMade }: { onMade: () => void }) {
  const [role, setRole] = useState<Role>("trainer");
  const [uses, setUses] = useState("1");
  const [hours, setHours] = useState("24");
  const [access, setAccess] = useState("");
  const [experiment, setExperiment] = useState("");
  const [note, setNote] = useState("");
  const [made, setMade] = useState<InvitationMade | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const wrong = (text: string, optional = false) =>
    (optional && text.trim() === "") || NUMBER.test(text.trim()) ? undefined : t("people.number");
  const invite = async (event: FormEvent) => {
    event.preventDefault();
    try {
      const of = experiment.trim();
      setMade(
        await http.invite({
          role,
          uses: Number(uses),
          hours: Number(hours),
          note: note.trim(),
          access_hours: access.trim() === "" ? null : Number(access),
          experiment_id: of === "" ? null : Number(of),
        }),
      );
      setProblem(null);
      onMade();
    } catch (error) {
      setProblem(http.problemOf(error));
    }
  };
  const errors = [wrong(uses), wrong(hours), wrong(access, true), wrong(experiment, true)];
  return (
    <form className="card invite" onSubmit={(event) => void invite(event)}>
      <h2>{t("people.invite")}</h2>
      <div className="fields">
        <Choice
          label={t("people.role")}
          name="role"
          value={role}
          options={roleOptions()}
          hint={t(`people.role_${role}_what`)}
          onChange={(value) => setRole(value as Role)}
        />
        <Field
          label={t("people.uses")}
          name="uses"
          value={uses}
          numeric
          error={errors[0]}
          onChange={setUses}
        />
        <Field
          label={t("people.hours")}
          name="hours"
          value={hours}
          numeric
          error={errors[1]}
          onChange={setHours}
        />
        <Field
          label={t("people.access")}
          name="access"
          value={access}
          numeric
          hint={t("people.accessWhat")}
          error={errors[2]}
          onChange={setAccess}
        />
        <Field
          label={t("people.experiment")}
          name="experiment"
          value={experiment}
          numeric
          hint={t("people.experimentWhat")}
          error={errors[3]}
          onChange={setExperiment}
        />
        <Field label={t("people.note")} name="note" value={note} onChange={setNote} />
      </div>
      {problem && (
        <p className="error" role="alert">
          {problem.detail} {problem.remedy}
        </p>
      )}
      <button type="submit" className="button primary" disabled={errors.some(Boolean)} data-testid="invite">
        {t("people.makeLink")}
      </button>
      {made && <NewLink key={made.id} made={made} />}
    </form>
  );
}

function PersonRow(props: { person: Person; onAsk: (question: Question) => void; onChanged: () => void }) {
  const { person } = props;
  const [problem, setProblem] = useState<Problem | null>(null);
  const act = (what: Promise<unknown>) =>
    void what.then(props.onChanged, (error: unknown) => setProblem(http.problemOf(error)));
  const out = () =>
    props.onAsk({
      title: t("people.letOutAsk", { name: person.name }),
      text: t("people.letOutWhat"),
      yes: t("people.letOut"),
      danger: true,
      testId: "let-out-yes",
      act: () => act(http.letOut(person.id)),
    });
  const where = person.online ?? [];
  const state = person.revoked_at
    ? t("people.wasLetOut", { at: moment(person.revoked_at) })
    : where.length
      ? t("people.onlineIn", { experiments: where.join(", ") })
      : t("people.offline");
  return (
    <li className="row person" data-testid="person">
      <div>
        <div className="title-line">
          <h3>{person.name}</h3>
          <span className={where.length ? "presence here" : "presence"}>{state}</span>
        </div>
        <p className="facts">
          {person.experiment_id ? t("people.only", { experiment: person.experiment_id }) : t("people.all")}
          {person.access_until ? ` · ${t("people.until", { at: moment(person.access_until) })}` : ""}
        </p>
        {problem && (
          <p className="error" role="alert">
            {problem.detail} {problem.remedy}
          </p>
        )}
      </div>
      {person.revoked_at || !may(person.role) || person.name === ME ? (
        <span className="facts">{t(`people.role_${person.role}`)}</span>
      ) : (
        <div className="actions">
          {may("owner") ? (
            <Choice
              label={t("people.roleOf", { name: person.name })}
              name={`role-${person.id}`}
              value={person.role}
              options={roleOptions()}
              onChange={(role) => act(http.giveRole(person.id, role as Role))}
            />
          ) : (
            <span className="facts">{t(`people.role_${person.role}`)}</span>
          )}
          <button type="button" className="button" onClick={out} data-testid="let-out">
            {t("people.letOut")}
          </button>
        </div>
      )}
    </li>
  );
}

function InvitationRow({ invitation, onChanged }: { invitation: Invitation; onChanged: () => void }) {
  const over =
    invitation.revoked_at !== null ||
    invitation.used >= invitation.uses ||
    new Date(invitation.expires_at).getTime() < Date.now();
  return (
    <li className="row" data-testid="invitation">
      <div>
        <h3>{invitation.note || t(`people.role_${invitation.role}`)}</h3>
        <p className="facts">
          {t("people.used", { used: invitation.used, uses: invitation.uses })}
          {" · "}
          {t("people.linkUntil", { at: moment(invitation.expires_at) })}
          {" · "}
          {t("people.by", { name: invitation.invited_by })}
        </p>
      </div>
      {over ? (
        <span className="facts">{t("people.over")}</span>
      ) : (
        <button
          type="button"
          className="button"
          onClick={() => void http.withdraw(invitation.id).then(onChanged, onChanged)}
          data-testid="withdraw"
        >
          {t("people.withdraw")}
        </button>
      )}
    </li>
  );
}

export function PeoplePage() {
  const people = usePolled(http.people, REFRESH_MS);
  const invitations = usePolled(http.invitations, REFRESH_MS);
  const [question, setQuestion] = useState<Question | null>(null);
  useEffect(() => {
    document.title = `${t("people.title")} · SEED`;
  }, []);
  const problem = people.problem ?? invitations.problem;
  const refresh = () => {
    people.refresh();
    invitations.refresh();
  };
  return (
    <>
      <Header back />
      <main className="page narrow people">
        <div className="title-row">
          <h1 className="title-text">{t("people.title")}</h1>
          <a className="button" href={http.auditTable()} download data-testid="audit">
            {t("people.audit")}
          </a>
        </div>
        {problem && <ProblemBanner problem={problem} onRetry={refresh} />}
        <Invite onMade={refresh} />
        <section>
          <h2>{t("people.who")}</h2>
          {people.value === null && !problem && (
            <div className="skeleton" role="status" aria-label={t("common.loading")} />
          )}
          <ul className="rows">
            {people.value?.map((person) => (
              <PersonRow key={person.id} person={person} onAsk={setQuestion} onChanged={refresh} />
            ))}
          </ul>
        </section>
        <section>
          <h2>{t("people.invitations")}</h2>
          {invitations.value?.length === 0 && <p className="facts">{t("people.noInvitations")}</p>}
          <ul className="rows">
            {invitations.value?.map((invitation) => (
              <InvitationRow key={invitation.id} invitation={invitation} onChanged={refresh} />
            ))}
          </ul>
        </section>
      </main>
      {question && <Confirm question={question} onClose={() => setQuestion(null)} />}
    </>
  );
}

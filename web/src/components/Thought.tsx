// What the agent thinks: the feedback it expects, which can be hidden, and its choices of a skill in their order.
import { t } from "../i18n";
import { decimal, signed } from "../i18n/numbers";
import { change, useSettings } from "../settings";
import type { Proposal } from "../wire";
import { Choices } from "./Choices";

const bound = (value: number) => Math.max(-1, Math.min(1, value));
const along = (value: number) => 50 + 50 * bound(value);

function Gauge({ value, uncertainty }: { value: number; uncertainty: number | null }) {
  const bounded = bound(value);
  const half = Math.abs(bounded) * 50;
  const [low, high] = [along(value - (uncertainty ?? 0)), along(value + (uncertainty ?? 0))];
  return (
    <div className="gauge-row">
      <span className="soft">{t("agent.expects")}</span>
      <meter className="sr-only" aria-label={t("agent.meter")} min={-1} max={1} value={bounded} />
      <div className="track centred" aria-hidden="true">
        <i
          data-tone={bounded < 0 ? "bad" : "good"}
          style={{ left: `${bounded < 0 ? 50 - half : 50}%`, width: `${half}%` }}
        />
        {uncertainty !== null && <i className="reach" style={{ left: `${low}%`, width: `${high - low}%` }} />}
      </div>
      <span className="number">
        <b data-testid="predicted-feedback">{signed(value)}</b>
        {uncertainty !== null && (
          <span className="soft" data-testid="uncertainty" title={t("agent.uncertainty")}>
            {` ± ${decimal(uncertainty)}`}
          </span>
        )}
      </span>
    </div>
  );
}

function Expected({ proposal }: { proposal: Proposal }) {
  const { estimate } = useSettings();
  return (
    <div>
      <h2 className="with-action">
        <span>
          {t("agent.predicted")} <abbr title={t("agent.critic")}>Ĥ</abbr>
        </span>
        <button
          type="button"
          className="link"
          aria-pressed={!estimate}
          title={t("tools.estimateWhat")}
          data-testid="hide-estimate"
          onClick={() => change({ estimate: !estimate })}
        >
          {estimate ? t("agent.hide") : t("agent.show")}
        </button>
      </h2>
      {estimate ? (
        <Gauge value={proposal.predicted_feedback} uncertainty={proposal.uncertainty} />
      ) : (
        <p className="hint" data-testid="estimate-hidden">
          {t("agent.hidden")}
        </p>
      )}
      {estimate && proposal.uncertainty === null && (
        <p className="hint" data-testid="uncertainty-unknown">
          {t("agent.uncertaintyUnknown")}
        </p>
      )}
    </div>
  );
}

export function Thought({ proposal }: { proposal: Proposal | null }) {
  return (
    <section className="card" aria-label={t("agent.label")}>
      {proposal ? (
        <div className="thought">
          <Expected proposal={proposal} />
          <Choices key={proposal.id} proposal={proposal} />
        </div>
      ) : (
        <>
          <h2>{t("agent.label")}</h2>
          <p className="soft">{t("agent.empty")}</p>
        </>
      )}
    </section>
  );
}

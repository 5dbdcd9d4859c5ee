// How the labels of an experiment came in, by time: good above the line, bad below it, what says neither in grey. Each
// bar leads to the first proposal that was judged in it; the Tab key reaches one, and the arrow keys the others.
import { type KeyboardEvent, useRef, useState } from "react";
import { t } from "../i18n";
import { clock, shortMoment, whole } from "../i18n/numbers";
import { Link } from "../router";
import type { Stretch, TimelineInfo } from "../wire";

/** Seconds up to which an axis tells seconds. */
const SHORT = 600;

const MOVES: Record<string, (at: number, last: number) => number> = {
  ArrowLeft: (at) => Math.max(at - 1, 0),
  ArrowRight: (at, last) => Math.min(at + 1, last),
  Home: () => 0,
  End: (_, last) => last,
};

const seconds = (iso: string): number => Date.parse(iso) / 1000;

const COUNTED = ["good", "neutral", "bad", "cant_tell", "executions", "violations"] as const;
type Counts = Pick<Stretch, (typeof COUNTED)[number]>;

function words({ good, neutral, bad, cant_tell, executions, violations }: Counts): string {
  const counts = { good, bad, neutral, cantTell: cant_tell, executed: executions, violation: violations };
  return Object.entries(counts)
    .filter(([key, count]) => count > 0 || key === "good" || key === "bad")
    .map(([key, count]) => `${whole(count)} ${t(`gallery.count_${key as keyof typeof counts}`)}`)
    .join(", ");
}

function total(stretches: Stretch[]): Counts {
  const sums = COUNTED.map((key) => [key, stretches.reduce((sum, each) => sum + each[key], 0)]);
  return Object.fromEntries(sums) as Counts;
}

function Axis({ from, to, write }: { from: string; to: string; write: (iso: string) => string }) {
  const middle = new Date((Date.parse(from) + Date.parse(to)) / 2).toISOString();
  return (
    <div className="timeline-axis" data-testid="timeline-axis">
      {[from, middle, to].map((iso, index) => (
        <time key={index} dateTime={iso}>
          {write(iso)}
        </time>
      ))}
    </div>
  );
}

export function Timeline({ id, told }: { id: number; told: TimelineInfo }) {
  const { stretches, started_at: from, ended_at: to } = told;
  const last = stretches.length - 1;
  const [reached, setReached] = useState(last);
  const [pointed, setPointed] = useState<number | null>(null);
  const bars = useRef<HTMLOListElement>(null);
  if (!from || !to) return null;
  const span = seconds(to) - seconds(from);
  const columns = Math.floor(span / told.seconds) + 1;
  const upper = ({ good, neutral, cant_tell }: Stretch) => good + neutral + cant_tell;
  const most = Math.max(...stretches.map((each) => Math.max(upper(each), each.bad)));
  const write = span <= SHORT ? clock : shortMoment;
  const move = (event: KeyboardEvent) => {
    const next = MOVES[event.key]?.(Math.min(reached, last), last);
    if (next === undefined) return;
    event.preventDefault();
    setReached(next);
    bars.current?.querySelectorAll("a")[next]?.focus();
  };
  const stretch = pointed === null ? undefined : stretches[pointed];
  return (
    <section className="card timeline" aria-label={t("gallery.timeline")} data-testid="timeline">
      <p className="soft" data-testid="timeline-words">
        {stretch
          ? `${write(stretch.at)}: ${words(stretch)}`
          : `${t("gallery.timeline")}: ${words(total(stretches))}`}
      </p>
      <ol
        ref={bars}
        style={{ gridTemplateColumns: `repeat(${columns}, minmax(0, 1fr))` }}
        onMouseLeave={() => setPointed(null)}
      >
        {stretches.map((each, index) => (
          <li
            key={each.at}
            style={{ gridColumn: Math.floor((seconds(each.at) - seconds(from)) / told.seconds) + 1 }}
          >
            <Link
              to={`/experiments/${id}/episodes/${each.episode}?proposal=${each.proposal}`}
              label={`${write(each.at)}: ${words(each)}`}
              tabIndex={index === Math.min(reached, last) ? 0 : -1}
              testId="stretch"
              onKeyDown={move}
              onFocus={() => {
                setReached(index);
                setPointed(index);
              }}
              onMouseEnter={() => setPointed(index)}
            >
              <Bar stretch={each} most={most} />
            </Link>
          </li>
        ))}
      </ol>
      <Axis from={from} to={to} write={write} />
    </section>
  );
}

function Bar({ stretch, most }: { stretch: Stretch; most: number }) {
  const { good, neutral, bad, cant_tell, executions, violations } = stretch;
  const part = (label: string, count: number) =>
    count > 0 && <i data-label={label} style={{ height: `${(100 * count) / most}%` }} />;
  return (
    <>
      <i data-came={violations > 0 ? "violation" : executions > 0 ? "executed" : "nothing"} />
      <span className="up">
        {part("good", good)}
        {part("neutral", neutral + cant_tell)}
      </span>
      <span className="down">{part("bad", bad)}</span>
    </>
  );
}

// One proposal in the gallery: its picture with what was proposed, its verdict and what came of it.
import { labelOf, stepPath } from "../gallery";
import { skillName, t } from "../i18n";
import { signed } from "../i18n/numbers";
import { Link } from "../router";
import type { HistoryEntry } from "../wire";
import { LABELS, Thumb } from "./History";
import { Bolt, Warning } from "./icons";

export function GalleryItem({ id, entry }: { id: number; entry: HistoryEntry }) {
  const { proposal, execution } = entry;
  const [view] = proposal.views;
  const label = labelOf(entry);
  const Icon = LABELS.find(({ key }) => key === label)?.Icon;
  const violated = (execution?.violations.length ?? 0) > 0;
  const words = [
    t("history.item", { number: proposal.number, skill: skillName(proposal.skill) }),
    proposal.purpose === "evaluation" ? t("gallery.purpose_evaluation") : "",
    label === "none" ? t("gallery.unjudged") : t(`judge.word.${label}`),
    execution ? t("history.executed") : "",
    violated ? t("history.violation") : "",
  ];
  return (
    <li>
      <Link
        to={stepPath(id, entry)}
        className="gallery-item"
        label={words.filter(Boolean).join(", ")}
        testId="gallery-item"
      >
        <span className="thumb" style={view && { aspectRatio: `${view.width} / ${view.height}` }}>
          {view && <Thumb view={view} />}
        </span>
        <span className="gallery-said" data-label={label}>
          {Icon ? <Icon /> : <span className="dot" />}
          <b>{skillName(proposal.skill)}</b>
          <span className="number soft">{proposal.number}</span>
          <span className="spring" />
          <span className="number soft">{signed(proposal.predicted_feedback)}</span>
          {execution && (violated ? <Warning /> : <Bolt />)}
        </span>
      </Link>
    </li>
  );
}

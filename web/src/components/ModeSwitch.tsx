import type { Mode } from "../wire";

const MODES: { mode: Mode; name: string }[] = [
  { mode: "propose_only", name: "Propose only" },
  { mode: "execute_approved", name: "Execute approved" },
];

export function ModeSwitch({ mode, onChange }: { mode: Mode; onChange: (mode: Mode) => void }) {
  return (
    <section className="card" aria-label="Mode">
      <fieldset className="segments" aria-label="What happens with an approved skill">
        {MODES.map((each) => (
          <label key={each.mode}>
            <input
              type="radio"
              name="mode"
              checked={mode === each.mode}
              onChange={() => onChange(each.mode)}
              data-testid={`mode-${each.mode}`}
            />
            {each.name}
          </label>
        ))}
      </fieldset>
      <p className="hint">
        {mode === "execute_approved"
          ? "A proposal you call good is run on the robot."
          : "Your clicks train; nothing moves."}
      </p>
    </section>
  );
}

// Labelled inputs with their error below.
import { type ReactNode, useId } from "react";

interface FieldProps {
  label: string;
  name: string;
  value: string;
  error?: string | undefined;
  wide?: boolean;
  /** What it means, below it. */
  hint?: string | undefined;
  onChange: (value: string) => void;
}

function Frame(props: {
  id: string;
  label: string;
  wide: boolean;
  error?: string | undefined;
  hint?: string | undefined;
  children: ReactNode;
}) {
  return (
    <div className={props.wide ? "field wide" : "field"}>
      <label htmlFor={props.id}>{props.label}</label>
      {props.children}
      {props.hint && (
        <p className="about" id={`${props.id}-hint`}>
          {props.hint}
        </p>
      )}
      {props.error && (
        <p className="error" id={`${props.id}-error`} role="alert">
          {props.error}
        </p>
      )}
    </div>
  );
}

function describedBy(id: string, { error, hint }: { error?: string | undefined; hint?: string | undefined }) {
  return [error && `${id}-error`, hint && `${id}-hint`].filter(Boolean).join(" ") || undefined;
}

export function Field(props: FieldProps & { numeric?: boolean }) {
  const id = useId();
  return (
    <Frame id={id} label={props.label} wide={props.wide ?? false} error={props.error} hint={props.hint}>
      <input
        id={id}
        name={props.name}
        value={props.value}
        inputMode={props.numeric ? "numeric" : "text"}
        autoComplete="off"
        aria-invalid={Boolean(props.error)}
        aria-describedby={describedBy(id, props)}
        onChange={(event) => props.onChange(event.target.value)}
      />
    </Frame>
  );
}

export function Choice(props: FieldProps & { options: { value: string; label: string }[] }) {
  const id = useId();
  return (
    <Frame id={id} label={props.label} wide={props.wide ?? false} error={props.error} hint={props.hint}>
      <select
        id={id}
        name={props.name}
        value={props.value}
        aria-invalid={Boolean(props.error)}
        aria-describedby={describedBy(id, props)}
        onChange={(event) => props.onChange(event.target.value)}
      >
        {props.options.map((option) => (
          <option key={option.value} value={option.value}>
            {option.label}
          </option>
        ))}
      </select>
    </Frame>
  );
}

// Labelled inputs with their error below.
import { type ReactNode, useId } from "react";

interface FieldProps {
  label: string;
  name: string;
  value: string;
  error?: string | undefined;
  wide?: boolean;
  onChange: (value: string) => void;
}

function Frame(props: {
  id: string;
  label: string;
  wide: boolean;
  error?: string | undefined;
  children: ReactNode;
}) {
  return (
    <div className={props.wide ? "field wide" : "field"}>
      <label htmlFor={props.id}>{props.label}</label>
      {props.children}
      {props.error && (
        <p className="error" id={`${props.id}-error`} role="alert">
          {props.error}
        </p>
      )}
    </div>
  );
}

export function Field(props: FieldProps & { numeric?: boolean }) {
  const id = useId();
  return (
    <Frame id={id} label={props.label} wide={props.wide ?? false} error={props.error}>
      <input
        id={id}
        name={props.name}
        value={props.value}
        inputMode={props.numeric ? "numeric" : "text"}
        autoComplete="off"
        aria-invalid={Boolean(props.error)}
        aria-describedby={props.error ? `${id}-error` : undefined}
        onChange={(event) => props.onChange(event.target.value)}
      />
    </Frame>
  );
}

export function Choice(props: FieldProps & { options: { value: string; label: string }[] }) {
  const id = useId();
  return (
    <Frame id={id} label={props.label} wide={props.wide ?? false} error={props.error}>
      <select
        id={id}
        name={props.name}
        value={props.value}
        aria-invalid={Boolean(props.error)}
        aria-describedby={props.error ? `${id}-error` : undefined}
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

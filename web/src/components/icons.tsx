// The few pictures of the page, drawn with the text's colour.

const stroke = {
  fill: "none",
  stroke: "currentColor",
  strokeWidth: 2,
  strokeLinecap: "round",
  strokeLinejoin: "round",
} as const;

export function Sprout() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M12 21v-9m0 1c0-4.5 3-7 8-7 0 4.5-3 7-8 7Zm0 3.5c0-3.5-2.5-5.5-7-5.5 0 3.5 2.5 5.5 7 5.5Z" />
    </svg>
  );
}

export function Octagon() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M8 2.5h8l5.5 5.5v8L16 21.5H8L2.5 16V8Z" />
      <path d="M8 12h8" strokeWidth={3} />
    </svg>
  );
}

export function Cross() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke} strokeWidth={2.6}>
      <path d="m6 6 12 12M18 6 6 18" />
    </svg>
  );
}

export function Dash() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke} strokeWidth={2.6}>
      <path d="M5 12h14" />
    </svg>
  );
}

/** Crossed out: nothing can be told from the view. */
export function Eye() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M2.5 12s3.5-6 9.5-6 9.5 6 9.5 6-3.5 6-9.5 6-9.5-6-9.5-6Z" />
      <circle cx="12" cy="12" r="2.6" />
      <path d="m4 20 16-16" />
    </svg>
  );
}

export function Tick() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke} strokeWidth={2.6}>
      <path d="m4.5 12.5 5 5 10-11" />
    </svg>
  );
}

export function Sliders() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M4 7h9m5 0h2M4 17h2m5 0h9" />
      <circle cx="15.5" cy="7" r="2.5" />
      <circle cx="8.5" cy="17" r="2.5" />
    </svg>
  );
}

export function Plus() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M12 6v12M6 12h12" />
    </svg>
  );
}

export function Minus() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M6 12h12" />
    </svg>
  );
}

export function Whole() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M9 4H4v5m11-5h5v5M9 20H4v-5m11 5h5v-5" />
    </svg>
  );
}

export function Ghost() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M5 11V8h14v3M7 11v8m10-8v8M12 4v4" />
    </svg>
  );
}

export function Room() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="m4 16 8 4 8-4M4 16V8l8-4 8 4v8M4 8l8 4 8-4M12 12v8" />
    </svg>
  );
}

export function Gauge() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M4 17a8 8 0 1 1 16 0M12 17l4-6" />
    </svg>
  );
}

export function Orbit() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <ellipse cx="12" cy="12" rx="9" ry="4" />
      <path d="M12 3c2.2 0 4 4 4 9s-1.8 9-4 9-4-4-4-9 1.8-9 4-9Z" />
    </svg>
  );
}

export function Question() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M9 9a3 3 0 1 1 4.5 2.600c-1 .6-1.5 1.200-1.5 2.400M12 18v.1" />
    </svg>
  );
}

export function TurnLeft() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M5 8v5h5M5.5 13a7 7 0 1 1 2 5" />
    </svg>
  );
}

export function TurnRight() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M19 8v5h-5m4.5 0a7 7 0 1 0-2 5" />
    </svg>
  );
}

export function Bolt() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M13 3 5 14h6l-1 7 8-11h-6Z" />
    </svg>
  );
}

export function Warning() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M12 4 3 20h18L12 4Zm0 6v5m0 2.5v.1" />
    </svg>
  );
}

export function Download() {
  return (
    <svg viewBox="0 0 24 24" aria-hidden="true" {...stroke}>
      <path d="M12 4v11m-4.5-4.5L12 15l4.5-4.5M5 19.5h14" />
    </svg>
  );
}

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

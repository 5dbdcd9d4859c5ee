// Numbers as the reader's language writes them.
import { language } from "./index";

function fixed(value: number, digits: number): string {
  return new Intl.NumberFormat(language(), {
    minimumFractionDigits: digits,
    maximumFractionDigits: digits,
  }).format(value);
}

/** With as many digits after the point. */
export function decimal(value: number, digits = 2): string {
  const zero = Number(value.toFixed(digits)) === 0; // which has no sign
  return fixed(zero ? 0 : value, digits).replace("-", "−");
}

/** A count, with its thousands apart. */
export const whole = (value: number) => value.toLocaleString(language());

/** 0.42 as "42 %". */
export const percent = (share: number, digits = 0) => `${fixed(100 * share, digits)} %`;

/** As "+0.42", with a true minus, and without a sign at 0. */
export function signed(value: number, digits = 2): string {
  const text = fixed(Math.abs(value), digits);
  if (Number(Math.abs(value).toFixed(digits)) === 0) return text;
  return value < 0 ? `−${text}` : `+${text}`;
}

/** Without year and seconds, which a list of what goes on hardly needs. */
export const shortMoment = (iso: string) =>
  new Date(iso).toLocaleString(language(), {
    day: "numeric",
    month: "short",
    hour: "2-digit",
    minute: "2-digit",
  });

/** The time of a day, to the second. */
export const clock = (iso: string) =>
  new Date(iso).toLocaleTimeString(language(), { hour: "2-digit", minute: "2-digit", second: "2-digit" });

export const moment = (iso: string) => new Date(iso).toLocaleString(language());

/** Three digits and a word for the thousands: on an axis there is little room. */
export function compact(value: number): string {
  const format = new Intl.NumberFormat(language(), { notation: "compact", maximumSignificantDigits: 3 });
  return format.format(value).replace("-", "−");
}

/** "ann, bob and cyd". */
export const listed = (names: string[]) =>
  new Intl.ListFormat(language(), { type: "conjunction" }).format(names);

// Settings as their JSON Schema describes them: what kind of field each is, its bounds in words, and what was changed.

export type Json = string | number | boolean | null | Json[] | { [key: string]: Json };
export type Values = Record<string, Json>;

interface Node {
  type?: string;
  title?: string;
  description?: string;
  default?: Json;
  enum?: Json[];
  const?: Json;
  anyOf?: Node[];
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  exclusiveMaximum?: number;
}

export interface Setting {
  name: string;
  kind: "number" | "integer" | "boolean" | "choice" | "text" | "json";
  description: string;
  fallback: Json;
  choices: string[];
  /** May be nothing at all. */
  nullable: boolean;
  low: { at: number; open: boolean } | null;
  high: { at: number; open: boolean } | null;
}

export interface Schema {
  properties?: Record<string, unknown>;
}

/** Of `X or nothing` the X. */
function unwrapped(node: Node): { node: Node; nullable: boolean } {
  const options = node.anyOf?.filter((each) => each.type !== "null");
  if (!node.anyOf || options?.length !== 1) return { node, nullable: false };
  return { node: { ...node, ...options[0] }, nullable: options.length < node.anyOf.length };
}

function kindOf(node: Node): Setting["kind"] {
  if (node.enum) return "choice";
  if (node.type === "number" || node.type === "integer" || node.type === "boolean") return node.type;
  return node.type === "string" ? "text" : "json";
}

function bound(closed: number | undefined, open: number | undefined): Setting["low"] {
  if (closed !== undefined) return { at: closed, open: false };
  return open === undefined ? null : { at: open, open: true };
}

export function settingsOf(schema: Schema | undefined): Setting[] {
  return Object.entries(schema?.properties ?? {}).map(([name, raw]) => {
    const { node, nullable } = unwrapped(raw as Node);
    const kind = kindOf(node);
    return {
      name,
      kind,
      description: node.description ?? "",
      fallback: node.default ?? (kind === "json" && !nullable ? {} : null),
      choices: (node.enum ?? []).map(String),
      nullable,
      low: bound(node.minimum, node.exclusiveMinimum),
      high: bound(node.maximum, node.exclusiveMaximum),
    };
  });
}

/** Its bounds as an interval, "(0, 0.1]"; empty where there are none. */
export function intervalOf({ low, high }: Setting): string {
  if (!low && !high) return "";
  const from = low ? `${low.open ? "(" : "["}${low.at}` : "(−∞";
  const to = high ? `${high.at}${high.open ? ")" : "]"}` : "∞)";
  return `${from}, ${to}`.replaceAll("-", "−");
}

/** A value as it stands in a field. */
export function shownAs(value: Json): string {
  if (value === null) return "";
  return typeof value === "string" ? value : JSON.stringify(value);
}

/** What a field's text says; text that says nothing the kind knows goes to the service as it is, which says why not. */
export function readAs(setting: Setting, text: string): Json {
  const trimmed = text.trim();
  if (trimmed === "" && setting.nullable) return null;
  if (setting.kind === "number" || setting.kind === "integer") {
    const value = Number(trimmed.replace("−", "-"));
    return trimmed !== "" && Number.isFinite(value) ? value : text;
  }
  if (setting.kind === "boolean") return trimmed === "true";
  if (setting.kind !== "json") return text;
  try {
    return JSON.parse(trimmed) as Json;
  } catch {
    return text;
  }
}

/** Every setting as the preset has it, over the defaults. */
export function baseOf(settings: Setting[], preset: Values = {}): Values {
  return Object.fromEntries(settings.map(({ name, fallback }) => [name, preset[name] ?? fallback]));
}

const same = (one: Json | undefined, other: Json | undefined) =>
  JSON.stringify(one) === JSON.stringify(other);

/** Those that differ from the base, which are all that is sent. */
export function differences(values: Values, base: Values): Values {
  return Object.fromEntries(Object.entries(values).filter(([name, value]) => !same(value, base[name])));
}

// Which experiments the list shows and in which order, as the page's address says it.
type Query = NonNullable<import("./api").paths["/api/v1/experiments"]["get"]["parameters"]["query"]>;
export type Sort = NonNullable<Query["sort"]>;
export type Order = NonNullable<Query["order"]>;

export const SORTS: Sort[] = [
  "created",
  "updated",
  "name",
  "feedback",
  "good_share",
  "successes",
  "violations",
];
export const NARROWING = ["task", "adapter", "algorithm", "lifecycle"] as const;
export type Narrowing = (typeof NARROWING)[number];
export const STATES = ["created", "running", "paused", "finished", "failed", "archived", "halted"] as const;

const KNOWN = [...NARROWING, "text", "tag", "sort", "order"];

/** What of an address is about the list; a sort that there isn't is none. */
export function listingOf(search: string): URLSearchParams {
  const all = new URLSearchParams(search);
  const listing = new URLSearchParams();
  for (const [key, value] of all) {
    if (!KNOWN.includes(key) || !value) continue;
    if (key === "sort" && !SORTS.includes(value as Sort)) continue;
    if (key === "order" && value !== "asc" && value !== "desc") continue;
    listing.append(key, value);
  }
  return listing;
}

export function sortOf(listing: URLSearchParams): { sort: Sort; order: Order } {
  return {
    sort: (listing.get("sort") as Sort | null) ?? "created",
    order: listing.get("order") === "asc" ? "asc" : "desc",
  };
}

/** With this in the place of what was there; empty takes it away. */
export function changed(listing: URLSearchParams, key: string, value: string): URLSearchParams {
  const next = new URLSearchParams(listing);
  if (value) next.set(key, value);
  else next.delete(key);
  return next;
}

/** A column is ordered by what is most first, a name by the alphabet; pressed again, the other way round. */
export function sortedBy(listing: URLSearchParams, sort: Sort): URLSearchParams {
  const now = sortOf(listing);
  const first: Order = sort === "name" ? "asc" : "desc";
  const order = now.sort === sort ? (now.order === "desc" ? "asc" : "desc") : first;
  return changed(changed(listing, "sort", sort), "order", order);
}

export function withTag(listing: URLSearchParams, tag: string): URLSearchParams {
  const next = new URLSearchParams(listing);
  if (!next.getAll("tag").includes(tag)) next.append("tag", tag);
  return next;
}

export function withoutTag(listing: URLSearchParams, tag: string): URLSearchParams {
  const next = new URLSearchParams(listing);
  const rest = next.getAll("tag").filter((each) => each !== tag);
  next.delete("tag");
  for (const each of rest) next.append("tag", each);
  return next;
}

/** Whether anything narrows it: an empty list then means something else. */
export const isNarrowed = (listing: URLSearchParams): boolean =>
  [...NARROWING, "text", "tag"].some((key) => listing.has(key));

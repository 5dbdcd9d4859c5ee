// Client-made ids. `crypto.randomUUID` doesn't exist on a plain-http LAN address; `getRandomValues` does.

export function newId(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
}

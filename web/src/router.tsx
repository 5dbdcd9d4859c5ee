// A handful of pages need no routing library: the History API and one store.
import { type MouseEvent, type ReactNode, useSyncExternalStore } from "react";
import { at, BASE } from "./base";

const listeners = new Set<() => void>();

function subscribe(listener: () => void): () => void {
  listeners.add(listener);
  window.addEventListener("popstate", listener);
  return () => {
    listeners.delete(listener);
    window.removeEventListener("popstate", listener);
  };
}

function tellAll(): void {
  for (const listener of listeners) listener();
}

export function navigate(path: string): void {
  history.pushState(null, "", at(path));
  window.scrollTo(0, 0);
  tellAll();
}

/** What a page shows is in its address, so that it can be sent and reloaded; it is still the same page. */
export function setSearch(search: URLSearchParams): void {
  const text = search.toString();
  history.replaceState(null, "", location.pathname + (text ? `?${text}` : ""));
  tellAll();
}

export function usePath(): string {
  return useSyncExternalStore(subscribe, () => location.pathname.slice(BASE.length) || "/");
}

export function useSearch(): string {
  return useSyncExternalStore(subscribe, () => location.search);
}

export function Link(props: {
  to: string;
  className?: string;
  label?: string;
  current?: boolean;
  testId?: string;
  children: ReactNode;
}) {
  const go = (event: MouseEvent) => {
    if (event.metaKey || event.ctrlKey || event.shiftKey || event.button !== 0) return;
    event.preventDefault();
    navigate(props.to);
  };
  return (
    <a
      href={at(props.to)}
      className={props.className}
      aria-label={props.label}
      aria-current={props.current ? "page" : undefined}
      data-testid={props.testId}
      onClick={go}
    >
      {props.children}
    </a>
  );
}

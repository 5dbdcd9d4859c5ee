// A handful of pages need no routing library: the History API and one store.
import { type ComponentProps, type MouseEvent, type ReactNode, useSyncExternalStore } from "react";
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

type Own = "tabIndex" | "onFocus" | "onKeyDown" | "onMouseEnter";

export function Link({
  to,
  label,
  current,
  testId,
  children,
  ...own
}: {
  to: string;
  className?: string;
  label?: string;
  current?: boolean;
  testId?: string;
  children: ReactNode;
} & Pick<ComponentProps<"a">, Own>) {
  const go = (event: MouseEvent) => {
    if (event.metaKey || event.ctrlKey || event.shiftKey || event.button !== 0) return;
    event.preventDefault();
    navigate(to);
  };
  return (
    <a
      {...own}
      href={at(to)}
      aria-label={label}
      aria-current={current ? "page" : undefined}
      data-testid={testId}
      onClick={go}
    >
      {children}
    </a>
  );
}

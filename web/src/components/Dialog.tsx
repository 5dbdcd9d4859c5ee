// A dialog in a layer beside the page. The page behind it is inert; the emergency stop, in a layer above, is not:
// that is why this isn't the browser's own modal dialog, which would make the stop unreachable.

import { type ReactNode, useEffect, useEffectEvent, useId, useRef } from "react";
import { createPortal } from "react-dom";
import { t } from "../i18n";

export function Dialog(props: { title: string; wide?: boolean; onClose: () => void; children: ReactNode }) {
  const titleId = useId();
  const box = useRef<HTMLDivElement>(null);
  const close = useEffectEvent(() => props.onClose());
  useEffect(() => {
    const before = document.activeElement;
    const page = document.getElementById("root");
    page?.setAttribute("inert", "");
    document.documentElement.dataset.dialog = "open";
    const first = box.current?.querySelector<HTMLElement>("[data-first], input, select, button");
    first?.focus();
    const onKey = (event: KeyboardEvent) => {
      if (event.key === "Escape") close();
    };
    window.addEventListener("keydown", onKey);
    return () => {
      window.removeEventListener("keydown", onKey);
      delete document.documentElement.dataset.dialog;
      page?.removeAttribute("inert");
      if (before instanceof HTMLElement) before.focus();
    };
  }, []);
  return createPortal(
    <div className="shade">
      <div
        className={props.wide ? "dialog wide" : "dialog"}
        role="dialog"
        aria-modal="true"
        aria-labelledby={titleId}
        ref={box}
      >
        <h2 id={titleId}>{props.title}</h2>
        {props.children}
      </div>
    </div>,
    document.body,
  );
}

export interface Question {
  title: string;
  text: string;
  yes: string;
  danger?: boolean;
  testId: string;
  act: () => void;
}

/** Asks before something that can't be taken back or lets a robot move. */
export function Confirm({ question, onClose }: { question: Question; onClose: () => void }) {
  const agree = () => {
    onClose();
    question.act();
  };
  return (
    <Dialog title={question.title} onClose={onClose}>
      <p className="soft">{question.text}</p>
      <div className="actions">
        <button type="button" className="button" data-first onClick={onClose} data-testid="cancel">
          {t("common.cancel")}
        </button>
        <button
          type="button"
          className={question.danger ? "button danger" : "button primary"}
          onClick={agree}
          data-testid={question.testId}
        >
          {question.yes}
        </button>
      </div>
    </Dialog>
  );
}

/** Whether a dialog covers the page: keys must not judge behind it. */
export function dialogOpen(): boolean {
  return document.documentElement.dataset.dialog === "open";
}

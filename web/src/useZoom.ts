// Wheel, pinch, drag and double click on a view: zoom, pan, and on a touch screen strokes that judge.
import { type RefObject, useEffect, useEffectEvent, useRef, useState } from "react";
import type { Press } from "./useJudging";
import {
  forProposal,
  pan,
  type Share,
  type Swipe,
  swipeOf,
  WHOLE,
  type Zoom,
  type Zoomed,
  zoomAt,
} from "./zoom";

interface Finger {
  x: number;
  y: number;
}

export interface Zooming {
  zoom: Zoom;
  /** Whether the whole picture is shown only because the chosen part of it doesn't hold what is to be judged. */
  away: boolean;
  nearer: () => void;
  farther: () => void;
  whole: () => void;
  /** The stroke that would judge if the finger were lifted now. */
  stroke: Swipe | null;
}

const STEP = 1.4;

/** What is to be judged: its proposal, and where its marks are. */
export interface Sought {
  id: number;
  points: readonly Share[];
}

/** `onSwipe` is told of a stroke of one finger while nothing is zoomed. */
export function useZoom(
  frame: RefObject<HTMLElement | null>,
  sought: Sought | null,
  onSwipe?: (swipe: Swipe, press: Press) => void,
): Zooming {
  const [{ zoom, kept }, setZoomed] = useState<Zoomed>({ zoom: WHOLE, kept: null });
  const [soughtId, setSoughtId] = useState<number | null>(null);
  // While it is drawn, not after: nobody sees a proposal out of sight, not for a frame.
  if (sought && sought.id !== soughtId) {
    setSoughtId(sought.id);
    setZoomed((now) => forProposal(now, sought.points));
  }
  const setZoom = (next: (before: Zoom) => Zoom) =>
    setZoomed((now) => ({ zoom: next(now.zoom), kept: null }));
  const [stroke, setStroke] = useState<Swipe | null>(null);
  const fingers = useRef(new Map<number, Finger>());
  const begun = useRef<(Finger & { at: number }) | null>(null);

  const onWheel = useEffectEvent((event: WheelEvent) => {
    const box = frame.current?.getBoundingClientRect();
    // The page scrolls by the wheel as ever until something is zoomed; with Ctrl, or by a trackpad's pinch, it zooms.
    if (!box || !(event.ctrlKey || event.shiftKey || zoom.scale > 1)) return;
    event.preventDefault();
    const turned = event.deltaY || event.deltaX;
    const at = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height] as const;
    setZoom((before) => zoomAt(before, Math.exp(-turned / 300), ...at));
  });

  const onDown = useEffectEvent((event: PointerEvent) => {
    if (event.target instanceof Element && event.target.closest("button")) return;
    fingers.current.set(event.pointerId, { x: event.clientX, y: event.clientY });
    begun.current =
      event.pointerType === "touch" && fingers.current.size === 1 && zoom.scale === 1
        ? { x: event.clientX, y: event.clientY, at: event.timeStamp }
        : null;
    if (zoom.scale > 1) frame.current?.setPointerCapture(event.pointerId);
  });

  const onMove = useEffectEvent((event: PointerEvent) => {
    const box = frame.current?.getBoundingClientRect();
    const before = fingers.current.get(event.pointerId);
    if (!box || !before) return;
    if (event.pointerType === "mouse" && event.buttons === 0) {
      fingers.current.delete(event.pointerId); // its button was let go elsewhere
      return;
    }
    const now = { x: event.clientX, y: event.clientY };
    const others = [...fingers.current].filter(([id]) => id !== event.pointerId).map(([, finger]) => finger);
    fingers.current.set(event.pointerId, now);
    const [other] = others;
    if (other) {
      const apart = (finger: Finger) => Math.hypot(finger.x - other.x, finger.y - other.y) || 1;
      const middle = [
        ((now.x + other.x) / 2 - box.left) / box.width,
        ((now.y + other.y) / 2 - box.top) / box.height,
      ] as const;
      setZoom((last) => zoomAt(last, apart(now) / apart(before), ...middle));
    } else if (zoom.scale > 1)
      setZoom((last) => pan(last, (now.x - before.x) / box.width, (now.y - before.y) / box.height));
    else if (begun.current) setStroke(swipeOf(now.x - begun.current.x, now.y - begun.current.y));
  });

  const onUp = useEffectEvent((event: PointerEvent) => {
    fingers.current.delete(event.pointerId);
    const from = begun.current;
    begun.current = null;
    setStroke(null);
    if (!from || event.type !== "pointerup") return;
    const swipe = swipeOf(event.clientX - from.x, event.clientY - from.y);
    if (swipe) onSwipe?.(swipe, { begun: from.at, ended: event.timeStamp });
  });

  const onDouble = useEffectEvent((event: MouseEvent) => {
    const box = frame.current?.getBoundingClientRect();
    if (!box || (event.target instanceof Element && event.target.closest("button"))) return;
    const at = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height] as const;
    setZoom((before) => (before.scale > 1 ? WHOLE : zoomAt(before, 2.5, ...at)));
  });

  const onKey = useEffectEvent((event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return; // the browser zooms its page by them
    const steps: Record<string, [number, number]> = {
      ArrowLeft: [0.1, 0],
      ArrowRight: [-0.1, 0],
      ArrowUp: [0, 0.1],
      ArrowDown: [0, -0.1],
    };
    const by = event.shiftKey ? steps[event.key] : undefined;
    if (event.key === "+" || event.key === "=") setZoom((before) => zoomAt(before, STEP));
    else if (event.key === "-") setZoom((before) => zoomAt(before, 1 / STEP));
    else if (event.key === "0") setZoom(() => WHOLE);
    else if (by) setZoom((before) => pan(before, ...by));
    else return;
    event.preventDefault();
  });

  useEffect(() => {
    const element = frame.current;
    if (!element) return;
    const listening: [string, (event: Event) => void, AddEventListenerOptions?][] = [
      ["wheel", (event) => onWheel(event as WheelEvent), { passive: false }],
      ["pointerdown", (event) => onDown(event as PointerEvent)],
      ["pointermove", (event) => onMove(event as PointerEvent)],
      ["pointerup", (event) => onUp(event as PointerEvent)],
      ["pointercancel", (event) => onUp(event as PointerEvent)],
      ["keydown", (event) => onKey(event as KeyboardEvent)],
      ["dblclick", (event) => onDouble(event as MouseEvent)],
    ];
    for (const [name, listener, options] of listening) element.addEventListener(name, listener, options);
    return () => {
      for (const [name, listener] of listening) element.removeEventListener(name, listener);
    };
  }, [frame]);

  return {
    zoom,
    away: kept !== null,
    stroke,
    nearer: () => setZoom((before) => zoomAt(before, STEP)),
    farther: () => setZoom((before) => zoomAt(before, 1 / STEP)),
    whole: () => setZoom(() => WHOLE),
  };
}

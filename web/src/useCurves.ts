// An experiment and its curves, asked for again when the stream tells that something has changed.
import { useCallback, useEffect, useRef, useState } from "react";
import * as http from "./http";
import type { Connection } from "./stream";
import { useEvents } from "./useEvents";
import type { Curves, Experiment, Problem, StreamEvent } from "./wire";

/** At most so often; and never more than a fifth of the service's time where an answer takes long. */
const LEAST_MS = 1500;
const SHARE = 5;
const TELLING = new Set<StreamEvent["type"]>([
  "metrics_added",
  "evaluation_changed",
  "execution_ended",
  "feedback_relabelled",
  "feedback_undone",
  "snapshot",
]);

export interface Watched {
  experiment: Experiment | null;
  curves: Curves | null;
  problem: Problem | null;
  connection: Connection;
}

export function useCurves(id: number): Watched {
  const [experiment, setExperiment] = useState<Experiment | null>(null);
  const [curves, setCurves] = useState<Curves | null>(null);
  const [problem, setProblem] = useState<Problem | null>(null);
  const loading = useRef({ wanted: false, busy: false });
  const load = useCallback(async () => {
    const state = loading.current;
    state.wanted = true;
    if (state.busy) return;
    state.busy = true;
    while (state.wanted) {
      state.wanted = false;
      const began = performance.now();
      try {
        setCurves(await http.curves(id));
        setProblem(null);
      } catch (error) {
        setProblem(http.problemOf(error));
      }
      const pause = Math.max(LEAST_MS, SHARE * (performance.now() - began));
      await new Promise((resolve) => setTimeout(resolve, pause));
    }
    state.busy = false;
  }, [id]);
  useEffect(() => {
    http.experiment(id).then(setExperiment, (error: unknown) => setProblem(http.problemOf(error)));
    void load();
  }, [id, load]);
  const connection = useEvents(id, (event) => {
    if (event.type === "snapshot" || event.type === "experiment_changed") setExperiment(event.experiment);
    if (TELLING.has(event.type)) void load();
  });
  return { experiment, curves, problem, connection };
}

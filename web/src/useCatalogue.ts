// What the catalogue tells, of everything or of one task or adapter; null until it is known.
import { useEffect, useState } from "react";
import * as http from "./http";
import type { Problem, TaskInfo } from "./wire";

export function useCatalogue(): { catalogue: http.Catalogue | null; problem: Problem | null } {
  const [answer, setAnswer] = useState<{ catalogue: http.Catalogue | null; problem: Problem | null }>({
    catalogue: null,
    problem: null,
  });
  useEffect(() => {
    http.catalogue().then(
      (catalogue) => setAnswer({ catalogue, problem: null }),
      (error: unknown) => setAnswer({ catalogue: null, problem: http.problemOf(error) }),
    );
  }, []);
  return answer;
}

export function useTask(name: string | undefined): TaskInfo | null {
  const [task, setTask] = useState<TaskInfo | null>(null);
  useEffect(() => {
    if (!name) return;
    let gone = false;
    http.task(name).then(
      (found) => gone || setTask(found),
      () => undefined, // what needs it stays away
    );
    return () => {
      gone = true;
    };
  }, [name]);
  return task;
}

/** Whether the adapter is a simulator; null while that isn't known. */
export function useSimulated(adapter: string | undefined): boolean | null {
  const [simulated, setSimulated] = useState<boolean | null>(null);
  useEffect(() => {
    if (!adapter) return;
    let gone = false;
    http.adapterList().then(
      (adapters) => gone || setSimulated(adapters.some((each) => each.name === adapter && each.simulated)),
      () => undefined, // as above
    );
    return () => {
      gone = true;
    };
  }, [adapter]);
  return simulated;
}

// What the catalogue tells of one task or adapter; null, or no, until it is known.
import { useEffect, useState } from "react";
import * as http from "./http";
import type { TaskInfo } from "./wire";

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

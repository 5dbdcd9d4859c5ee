// An experiment's stream for a page that only looks: its events, and no pictures.
import { useEffect, useEffectEvent, useState } from "react";
import { type Connection, Stream, streamUrl } from "./stream";
import type { StreamEvent } from "./wire";

/** Calls `onEvent` for each event; the connection's state is returned. */
export function useEvents(id: number, onEvent: (event: StreamEvent) => void): Connection {
  const [connection, setConnection] = useState<Connection>("connecting");
  const hear = useEffectEvent(onEvent);
  useEffect(() => {
    const stream = new Stream(streamUrl(id), null, {
      onEvent: (event) => hear(event),
      // the service sends the next picture after this one was answered: it never is
      onFrame: () => new Promise(() => undefined),
      onConnection: setConnection,
    });
    stream.start();
    return () => stream.stop();
  }, [id]);
  return connection;
}

import { t } from "../i18n";
import type { Connection } from "../stream";

/** Whether the page is in step with the service, and how many clicks wait to be sent. */
export function ConnectionState({ connection, pending }: { connection: Connection; pending: number }) {
  const open = connection === "open";
  const words = open
    ? t("connection.open")
    : pending > 0
      ? t("connection.kept", { count: pending })
      : t("connection.lost");
  return (
    <span className="connection" role="status" data-testid="connection" data-state={open ? "open" : "lost"}>
      <span className="dot" />
      <span className="words">{words}</span>
    </span>
  );
}

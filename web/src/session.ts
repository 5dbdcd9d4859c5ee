// Joins one experiment's stream, its outbox of clicks and the reducer: everything a trainer's page does to the world.

import { type Dispatch, useEffect, useMemo, useReducer } from "react";
import { FrameSink } from "./frames";
import { KEPT } from "./history";
import * as http from "./http";
import { t } from "./i18n";
import { newId } from "./ids";
import { ME, may, stillMe } from "./me";
import { type Click, comesAgain, Outbox } from "./outbox";
import { Recording } from "./recording";
import { type Action, initial, reduce, type TrainerState } from "./state";
import { type Follower, stops } from "./stops";
import { type Connection, Stream, streamUrl } from "./stream";
import { Telling } from "./telling";
import { judgeOf } from "./together";
import type { AutoApproval, Judge, Problem, Proposal, Reported, StreamEvent, Value, Verb } from "./wire";

const RESEND_MS = 3000;
/** Signs of life are told at most so often: a lease lasts for several of them. */
const LOOK_MS = 2000;

type Refused = Extract<StreamEvent, { type: "refused" }>;

export class Session {
  readonly frames = new FrameSink();
  readonly recording = new Recording();
  readonly telling = new Telling();
  private readonly stream: Stream;
  private readonly outbox: Outbox;
  private resend: ReturnType<typeof setTimeout> | undefined;
  private unfollow: () => void = () => undefined;
  private lookedAt = Number.NEGATIVE_INFINITY;
  private leasedAt = 0;
  private leaseSeconds = Number.POSITIVE_INFINITY;
  private given: number | null = null;
  private pastAsked = 0;
  /** By request, until it is answered; `again`: sent once more, since a dead connection may have swallowed it. */
  private readonly undos = new Map<string, { feedbackId: number; again: boolean }>();

  constructor(
    readonly id: number,
    private readonly dispatch: Dispatch<Action>,
  ) {
    this.outbox = new Outbox(id, ME, window.localStorage);
    this.stream = new Stream(streamUrl(id), ME, {
      onEvent: this.onEvent,
      onFrame: (frame) => {
        this.recording.keep(frame);
        if (frame.header.telemetry) this.telling.tell(frame.header.robot, frame.header.telemetry);
        return this.frames.show(frame);
      },
      onConnection: this.onConnection,
    });
  }

  open(): void {
    this.dispatch({ kind: "pending", clicks: this.outbox.all() });
    this.stream.start();
    if (stops.wanted(this.id)) this.dispatch({ kind: "stopping", stopping: "asked" });
    this.unfollow = stops.follow(this.id, this.stopping);
    http.newestEvaluation(this.id).then(
      (evaluation) => this.dispatch({ kind: "evaluation", evaluation }),
      () => undefined, // the stream tells of the next one
    );
    http.experiment(this.id).then(
      (experiment) => this.dispatch({ kind: "experiment", experiment }),
      (error: unknown) => {
        const problem = http.problemOf(error);
        if (problem.status === 404 || problem.status === 422) {
          this.stream.stop();
          this.dispatch({ kind: "fatal", problem });
        }
      },
    );
  }

  close(): void {
    this.stream.stop();
    clearTimeout(this.resend);
    this.unfollow();
  }

  /** Keep first, then send: a click survives a dead connection and a reload. */
  judge(proposal: Proposal, value: Value, estimateShown: boolean): void {
    if (this.outbox.all().some((click) => click.proposal_id === proposal.id)) return;
    const { observation_id, policy_version } = proposal;
    const click = this.outbox.add({
      click_id: newId(),
      proposal_id: proposal.id,
      value,
      estimate_shown: estimateShown,
      looked: { observation_id, policy_version },
    });
    this.send(click);
    this.leasedAt = performance.now();
    this.dispatch({ kind: "pending", clicks: this.outbox.all() });
  }

  /** The trainer is at it: what they have before them stays theirs. */
  look = (): void => {
    const now = performance.now();
    if (now - this.lookedAt < LOOK_MS || !this.stream.send({ type: "look" })) return;
    this.lookedAt = this.leasedAt = now;
  };

  /** Seconds until what this trainer has before them goes to the others, without a sign of life. */
  leaseLeft = (): number => this.leaseSeconds - (performance.now() - this.leasedAt) / 1000;

  /** True once it is kept. */
  async report(executionId: number, outcome: Reported): Promise<boolean> {
    try {
      const execution = await http.report(executionId, newId(), outcome);
      this.dispatch({ kind: "reported", execution });
      return true;
    } catch (error) {
      this.complain(error);
      return false;
    }
  }

  async relabel(feedbackId: number, value: Value): Promise<void> {
    try {
      const feedback = await http.relabel(feedbackId, newId(), value);
      this.dispatch({ kind: "relabelled", feedback });
    } catch (error) {
      this.complain(error);
    }
  }

  undo(feedbackId: number): void {
    if ([...this.undos.values()].some((undo) => undo.feedbackId === feedbackId)) return;
    const requestId = newId();
    if (this.stream.send({ type: "undo", request_id: requestId, feedback_id: feedbackId }))
      this.undos.set(requestId, { feedbackId, again: false });
    else this.dispatch({ kind: "notice", tone: "warning", text: t("notice.notTakenBack") });
  }

  /** By every way there is, and again until it is confirmed, also after this page is left. */
  halt(): void {
    this.dispatch({ kind: "stopping", stopping: "asked" });
    stops.ask(this.id);
  }

  async act(verb: Verb): Promise<void> {
    if (verb === "rearm") stops.forget(this.id);
    await this.guard(http.act(this.id, verb));
  }

  async tend(what: "home" | "recover"): Promise<void> {
    await this.guard(http.tend(this.id, what, ME));
  }

  async setMode(mode: "propose_only" | "execute_approved"): Promise<void> {
    await this.guard(http.setMode(this.id, mode));
  }

  async setAutoApproval(rule: AutoApproval | null): Promise<void> {
    await this.guard(http.setAutoApproval(this.id, rule));
  }

  async setTogether(change: http.TogetherChange): Promise<void> {
    await this.guard(http.setTogether(this.id, change));
  }

  async evaluate(rollouts: number): Promise<void> {
    try {
      await http.evaluate(this.id, rollouts);
    } catch (error) {
      this.complain(error);
    }
  }

  watch = (robot: number | null): void => this.dispatch({ kind: "watch", robot });

  notify = (text: string): void => this.dispatch({ kind: "notice", tone: "info", text });

  dismiss = (id: number): void => this.dispatch({ kind: "dismiss", id });

  private async guard(answer: ReturnType<typeof http.act>): Promise<void> {
    try {
      this.dispatch({ kind: "experiment", experiment: await answer });
    } catch (error) {
      this.complain(error);
    }
  }

  private complain(error: unknown): void {
    this.tellOf(http.problemOf(error));
  }

  tellOf = (problem: Problem): void => {
    this.dispatch({ kind: "notice", tone: "error", text: `${problem.detail} ${problem.remedy}` });
  };

  private readonly stopping: Follower = {
    ask: () => void this.stream.send({ type: "halt", request_id: newId() }),
    answered: (experiment) => this.dispatch({ kind: "experiment", experiment }),
    unreachable: () => this.dispatch({ kind: "stopping", stopping: "unreachable" }),
    refused: (problem) => {
      this.dispatch({ kind: "stopping", stopping: "no" });
      this.tellOf(problem);
    },
  };

  private send(click: Click): void {
    this.stream.send({ type: "feedback", ...click });
  }

  /** The service takes a click as that of whoever is signed in: so only once it is certain that they still sit here. */
  private sendKept(): void {
    stillMe().then(
      (same) => {
        if (!same) return;
        if (may("trainer")) this.outbox.adopt();
        const clicks = this.outbox.all();
        this.dispatch({ kind: "pending", clicks });
        for (const click of clicks) this.send(click);
      },
      () => this.sendLater(),
    );
  }

  private sendLater(): void {
    clearTimeout(this.resend);
    this.resend = setTimeout(() => this.sendKept(), RESEND_MS);
  }

  private onConnection = (connection: Connection): void => {
    this.dispatch({ kind: "connection", connection });
    if (connection !== "open") return;
    this.undoAgain(); // before the clicks that were made after it
    this.sendKept();
    stops.again(this.id);
    this.askPast();
    http.metrics(this.id).then(
      (points) => this.dispatch({ kind: "metrics", points }),
      () => undefined, // the curve goes on from the stream
    );
  };

  /** An answer to an earlier connection's question may be older than this one's. */
  private askPast(): void {
    this.pastAsked += 1;
    const asked = this.pastAsked;
    http.past(this.id, KEPT).then(
      ([proposals, feedback, executions]) => {
        if (asked === this.pastAsked) this.dispatch({ kind: "past", proposals, feedback, executions });
      },
      () => undefined, // the strip goes on from the stream
    );
  }

  private undoAgain(): void {
    for (const [requestId, undo] of this.undos) {
      undo.again = true;
      this.stream.send({ type: "undo", request_id: requestId, feedback_id: undo.feedbackId });
    }
  }

  /** One that was sent twice is refused where the first had come through: then all is as it was wanted. */
  private async undoRefused(feedbackId: number, refused: Refused): Promise<void> {
    const feedback = await http.feedback(feedbackId).catch(() => null);
    if (!feedback?.undone_at) this.dispatch({ kind: "event", event: refused });
  }

  private onEvent = (event: StreamEvent): void => {
    if ((event.type === "acknowledged" || event.type === "refused") && event.request_id) {
      const undo = this.undos.get(event.request_id);
      this.undos.delete(event.request_id);
      if (event.type === "refused" && undo?.again) {
        void this.undoRefused(undo.feedbackId, event);
        return;
      }
    }
    if (event.type === "robot_told") this.telling.tell(event.robot, event.telemetry);
    if (event.type === "attendance_changed" || event.type === "snapshot")
      this.telling.attended(event.operator ?? null);
    if (event.type === "snapshot")
      for (const { robot, telemetry } of event.robots) this.telling.tell(robot, telemetry);
    if (event.type === "acknowledged") this.outbox.remove(event.request_id);
    if (event.type === "feedback_stored") this.outbox.remove(event.feedback.click_id);
    if (event.type === "refused" && event.request_id) this.onRefused(event.request_id, event.problem.status);
    if (event.type === "snapshot") this.onSnapshot(event);
    if (event.type === "snapshot" || event.type === "experiment_changed")
      this.leaseSeconds = event.experiment.together.lease_seconds;
    if (event.type === "snapshot" || event.type === "judges_changed") this.onJudges(event.judges);
    if ((event.type === "snapshot" || event.type === "experiment_changed") && event.experiment.halted)
      stops.confirm(this.id);
    this.dispatch({ kind: "event", event });
  };

  private onSnapshot(event: Extract<StreamEvent, { type: "snapshot" }>): void {
    if (event.proposal) return;
    http.newestProposal(this.id).then(
      (proposal) => this.dispatch({ kind: "backdrop", proposal }),
      () => undefined, // no picture yet is fine
    );
  }

  /** What this trainer is given anew is theirs for a whole lease. */
  private onJudges(judges: Judge[]): void {
    const given = judgeOf(judges)?.proposal_id ?? null;
    if (given !== this.given) this.leasedAt = performance.now();
    this.given = given;
  }

  private onRefused(requestId: string, status: number): void {
    if (!comesAgain(status)) {
      this.outbox.remove(requestId);
      return;
    }
    this.sendLater();
  }
}

export function useSession(id: number): { state: TrainerState; session: Session } {
  const [state, dispatch] = useReducer(reduce, initial);
  const session = useMemo(() => new Session(id, dispatch), [id]);
  useEffect(() => {
    session.open();
    return () => session.close();
  }, [session]);
  return { state, session };
}

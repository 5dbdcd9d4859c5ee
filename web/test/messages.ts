// Wire messages with everything filled in, to vary in tests.
import type { Execution, Experiment, Feedback, Proposal, StreamEvent } from "../src/wire";

const AT = "2026-01-01T00:00:00Z";

export function experiment(change: Partial<Experiment> = {}): Experiment {
  return {
    id: 1,
    name: "Stacking 1",
    task: "stacking",
    adapter: "robosuite",
    algorithm: "seed",
    preset: null,
    settings: {},
    adapter_settings: {},
    seed: 0,
    mode: "execute_approved",
    aggregation: "first",
    feedback_timeout: null,
    teacher: null,
    teacher_settings: {},
    lockstep: false,
    num_envs: 1,
    lifecycle: "running",
    phase: "awaiting_feedback",
    halted: false,
    failure: null,
    catching_up: null,
    counters: {
      feedback: 0,
      good: 0,
      neutral: 0,
      bad: 0,
      cant_tell: 0,
      late: 0,
      relabelled: 0,
      proposals: 0,
      executions: 0,
      low_level_steps: 0,
      successes: 0,
      episodes: 0,
      violations: 0,
      auto_approved: 0,
    },
    auto_approval: null,
    auto_approval_suspended: null,
    gold_rate: 0,
    tags: [],
    practice_required: null,
    together: {
      parallel: false,
      least: 1,
      weighted_approves: false,
      lease_seconds: 60,
      vanish_seconds: 10,
      finish_seconds: 20,
    },
    created_at: AT,
    updated_at: AT,
    ...change,
  };
}

export function proposal(id: number, change: Partial<Proposal> = {}): Proposal {
  return {
    id,
    experiment_id: 1,
    robot: 0,
    slot: 0,
    episode: 1,
    number: id,
    observation_id: "o1",
    state: [0, 0, 0],
    skill: "pick",
    parameters: { x: 0.5, y: 0, z: 0 },
    digest: "d".repeat(64),
    predicted_feedback: 0.2,
    uncertainty: 0.15,
    skill_probabilities: { pick: 0.7, place: 0.3 },
    policy_version: 3,
    subgoal: "Pick the red block",
    views: ["left", "right"].map((camera) => ({
      camera,
      width: 640,
      height: 480,
      image: `hash-${camera}`,
      url: `/api/v1/proposals/${id}/images/${camera}`,
      overlay: {
        dot: [10, 20],
        line: null,
        arrow: false,
        bar: null,
        ring: null,
        in_view: true,
        ghost: [],
        yaw: null,
        workspace: [],
      },
    })),
    opened_at: AT,
    closed_at: null,
    close_reason: null,
    verdict: null,
    verdict_source: null,
    rule: null,
    superseded_by: null,
    electorate: ["local"],
    heard: [],
    audit: false,
    gate: null,
    purpose: "training",
    ...change,
  };
}

export function feedback(proposalId: number, change: Partial<Feedback> = {}): Feedback {
  return {
    id: proposalId,
    click_id: `click-${proposalId}`,
    proposal_id: proposalId,
    experiment_id: 1,
    trainer: "local",
    value: 1,
    label: change.value ?? 1,
    relabels: [],
    status: "stored",
    received_at: AT,
    undone_at: null,
    estimate_shown: null,
    late_because: null,
    ...change,
  };
}

export function execution(id: number, change: Partial<Execution> = {}): Execution {
  return {
    id,
    experiment_id: 1,
    proposal_id: 1,
    robot: 0,
    skill: "pick",
    parameters: {},
    started_at: AT,
    ended_at: null,
    outcome: null,
    end_reason: null,
    low_level_steps: 0,
    task_success: false,
    violations: [],
    reports: [],
    ...change,
  };
}

export function snapshot(
  change: Partial<Extract<StreamEvent, { type: "snapshot" }>> = {},
): Extract<StreamEvent, { type: "snapshot" }> {
  return {
    type: "snapshot",
    experiment: experiment(),
    proposal: null,
    execution: null,
    proposals: change.proposal ? [change.proposal] : [],
    executions: change.execution ? [change.execution] : [],
    undoable: null,
    finishing: null,
    judges: [],
    robots: [],
    operator: null,
    server_time: AT,
    boot_id: "boot-1",
    ...change,
  };
}

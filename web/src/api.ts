// Generated from the service's OpenAPI document by `npm run api`; `npm run check` fails where they differ.

export interface paths {
    "/api/v1/experiments": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** A */
        get: operations["a_api_v1_experiments_get"];
        put?: never;
        /** B */
        post: operations["b_api_v1_experiments_post"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tasks": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** T */
        get: operations["t_api_v1_tasks_get"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/adapters": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** T2 */
        get: operations["t2_api_v1_adapters_get"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/algorithms": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** T3 */
        get: operations["t3_api_v1_algorithms_get"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/m": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** M */
        get: operations["m_api_v1_m_get"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/e": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** E */
        get: operations["e_api_v1_e_get"];
        put?: never;
        /** E2 */
        post: operations["e2_api_v1_e_post"];
        delete?: never;
        options?: never;
        head?: never;
        /** Pp */
        patch: operations["pp_api_v1_e_patch"];
        trace?: never;
    };
    "/api/v1/p": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** P */
        get: operations["p_api_v1_p_get"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/p2": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /** P2 */
        get: operations["p2_api_v1_p2_get"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export interface webhooks {
    stream: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Ev */
        post: operations["evstream_post"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    client: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Cm */
        post: operations["cmclient_post"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    frame: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /** Fh */
        post: operations["fhframe_post"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
}
export interface components {
    schemas: {
        /**
         * Acknowledged
         * @description Answer to a client's message; for feedback it comes after the commit.
         */
        Acknowledged: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "acknowledged";
            /**
             * Request Id
             * @description the click id, or the request's own id
             */
            request_id: string;
            feedback?: components["schemas"]["Feedback"] | null;
        };
        /**
         * AdapterInfo
         * @description An adapter of the catalogue; `tasks` are those it can stage.
         */
        AdapterInfo: {
            /** Name */
            name: string;
            /** Description */
            description: string;
            /** Simulated */
            simulated: boolean;
            /** Tasks */
            tasks: string[];
            /** Settings Schema */
            settings_schema: {
                [key: string]: unknown;
            };
        };
        /**
         * Aggregation
         * @description How several trainers' feedback on one proposal adds up to a verdict.
         * @enum {string}
         */
        Aggregation: "first" | "majority" | "unanimous";
        /**
         * AlgorithmInfo
         * @description An algorithm of the catalogue; `settings_schema` is JSON Schema.
         */
        AlgorithmInfo: {
            /** Name */
            name: string;
            /** Description */
            description: string;
            /** Presets */
            presets: {
                [key: string]: {
                    [key: string]: unknown;
                };
            };
            /** Settings Schema */
            settings_schema: {
                [key: string]: unknown;
            };
        };
        /**
         * ClientFeedback
         * @description One click over the stream.
         */
        ClientFeedback: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "feedback";
            /**
             * Click Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            click_id: string;
            /** Proposal Id */
            proposal_id: number;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good
             */
            value: number;
            /**
             * Trainer
             * @default local
             */
            trainer: string;
        };
        /**
         * ClientFrameAck
         * @description The last frame is drawn: the next one may come.
         */
        ClientFrameAck: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "frame_ack";
        };
        /**
         * ClientHalt
         * @description Emergency stop.
         */
        ClientHalt: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "halt";
            /**
             * Request Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            request_id: string;
        };
        /**
         * ClientPing
         * @description Are you there?
         */
        ClientPing: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "ping";
        };
        /**
         * ClientUndo
         * @description Take back a feedback, while nothing has moved.
         */
        ClientUndo: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "undo";
            /**
             * Request Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            request_id: string;
            /** Feedback Id */
            feedback_id: number;
        };
        /**
         * CloseReason
         * @description Why a proposal is no longer open.
         * @enum {string}
         */
        CloseReason: "judged" | "timed_out" | "withdrawn" | "interrupted";
        /**
         * Counters
         * @description What happened so far in an experiment.
         */
        Counters: {
            /**
             * Feedback
             * @default 0
             */
            feedback: number;
            /**
             * Good
             * @default 0
             */
            good: number;
            /**
             * Neutral
             * @default 0
             */
            neutral: number;
            /**
             * Bad
             * @default 0
             */
            bad: number;
            /**
             * Late
             * @default 0
             */
            late: number;
            /**
             * Proposals
             * @default 0
             */
            proposals: number;
            /**
             * Executions
             * @default 0
             */
            executions: number;
            /**
             * Low Level Steps
             * @default 0
             */
            low_level_steps: number;
            /**
             * Successes
             * @default 0
             */
            successes: number;
            /**
             * Episodes
             * @default 0
             */
            episodes: number;
            /**
             * Violations
             * @default 0
             */
            violations: number;
        };
        /**
         * Evaluation
         * @description Rollouts of the deterministic policy (paper, section 'Evaluation metrics': 10 a time).
         */
        Evaluation: {
            /** Id */
            id: number;
            /** Experiment Id */
            experiment_id: number;
            /**
             * Feedback
             * @description feedback stored when it started
             */
            feedback: number;
            /** Policy Version */
            policy_version: number;
            /** Rollouts */
            rollouts: number;
            /** Successes */
            successes: number;
            /** Success Rate */
            success_rate: number;
            /** Low Level Steps */
            low_level_steps: number;
            /** Seed */
            seed: number;
            /**
             * Started At
             * Format: date-time
             */
            started_at: string;
            /** Ended At */
            ended_at?: string | null;
        };
        /**
         * EvaluationChanged
         * @description An evaluation started, went on or ended.
         */
        EvaluationChanged: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "evaluation_changed";
            evaluation: components["schemas"]["Evaluation"];
            /** Done */
            done: number;
        };
        /**
         * EvaluationCreate
         * @description Ask for rollouts of the deterministic policy (simulated adapters only).
         */
        EvaluationCreate: {
            /**
             * Rollouts
             * @default 10
             */
            rollouts: number;
            /**
             * Seed
             * @default 10000
             */
            seed: number;
        };
        /**
         * EvaluationPage
         * @description Evaluations, newest first.
         */
        EvaluationPage: {
            /** Next Cursor */
            next_cursor?: string | null;
            /** Items */
            items: components["schemas"]["Evaluation"][];
        };
        /**
         * Execution
         * @description One run of a skill call. `outcome` is null while it moves.
         */
        Execution: {
            /** Id */
            id: number;
            /** Experiment Id */
            experiment_id: number;
            /** Proposal Id */
            proposal_id: number;
            /** Skill */
            skill: string;
            /** Parameters */
            parameters: {
                [key: string]: number;
            };
            /**
             * Started At
             * Format: date-time
             */
            started_at: string;
            /** Ended At */
            ended_at?: string | null;
            outcome?: components["schemas"]["ExecutionOutcome"] | null;
            /**
             * End Reason
             * @description arrived, timeout, stalled, force_limit, stopped, ...
             */
            end_reason?: string | null;
            /**
             * Low Level Steps
             * @default 0
             */
            low_level_steps: number;
            /**
             * Task Success
             * @default false
             */
            task_success: boolean;
        };
        /**
         * ExecutionEnded
         * @description The robot stands still again.
         */
        ExecutionEnded: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "execution_ended";
            execution: components["schemas"]["Execution"];
            /**
             * Violations
             * @default []
             */
            violations: string[];
        };
        /**
         * ExecutionOutcome
         * @description How one run of a skill call on a robot ended.
         * @enum {string}
         */
        ExecutionOutcome: "succeeded" | "failed" | "stopped" | "interrupted";
        /**
         * ExecutionStarted
         * @description The robot moves; frames follow.
         */
        ExecutionStarted: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "execution_started";
            execution: components["schemas"]["Execution"];
        };
        /**
         * Experiment
         * @description An experiment as it is now.
         */
        Experiment: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /** Task */
            task: string;
            /** Adapter */
            adapter: string;
            /** Algorithm */
            algorithm: string;
            /** Preset */
            preset: string | null;
            /** Settings */
            settings: {
                [key: string]: unknown;
            };
            /** Adapter Settings */
            adapter_settings: {
                [key: string]: unknown;
            };
            /** Seed */
            seed: number;
            mode: components["schemas"]["Mode"];
            aggregation: components["schemas"]["Aggregation"];
            /** Feedback Timeout */
            feedback_timeout: number | null;
            /** Teacher */
            teacher: string | null;
            /** Lockstep */
            lockstep: boolean;
            lifecycle: components["schemas"]["Lifecycle"];
            phase: components["schemas"]["Phase"];
            /** Halted */
            halted: boolean;
            /**
             * Failure
             * @description why it failed, with the remedy
             */
            failure?: string | null;
            counters: components["schemas"]["Counters"];
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /**
             * Updated At
             * Format: date-time
             */
            updated_at: string;
        };
        /**
         * ExperimentChanged
         * @description Lifecycle, phase, mode, halt or counters changed.
         */
        ExperimentChanged: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "experiment_changed";
            experiment: components["schemas"]["Experiment"];
        };
        /**
         * ExperimentCreate
         * @description The body that creates an experiment.
         */
        ExperimentCreate: {
            /** Name */
            name: string;
            /**
             * Task
             * @description a name from GET /api/v1/tasks
             * @example stacking
             */
            task: string;
            /**
             * Adapter
             * @description a name from GET /api/v1/adapters
             * @default robosuite
             * @example robosuite
             */
            adapter: string;
            /**
             * Algorithm
             * @description a name from GET /api/v1/algorithms
             * @default seed
             * @example seed
             */
            algorithm: string;
            /**
             * Preset
             * @description a preset of the algorithm
             * @example paper_sim
             */
            preset?: string | null;
            /**
             * Settings
             * @description the algorithm's settings that differ from the preset
             */
            settings?: {
                [key: string]: unknown;
            };
            /**
             * Adapter Settings
             * @description the adapter's settings
             */
            adapter_settings?: {
                [key: string]: unknown;
            };
            /**
             * Seed
             * @default 0
             */
            seed: number;
            /** @default execute_approved */
            mode: components["schemas"]["Mode"];
            /** @default first */
            aggregation: components["schemas"]["Aggregation"];
            /**
             * Feedback Timeout
             * @description seconds until an unjudged proposal closes without a verdict; null: never
             */
            feedback_timeout?: number | null;
            /**
             * Teacher
             * @description a synthetic trainer that judges; null: people do
             * @example synthetic
             */
            teacher?: string | null;
            /**
             * Lockstep
             * @description true: owed gradient steps are worked off before the next proposal, so a run can be repeated exactly; false: they run while the human thinks; null: true with a teacher, else false
             */
            lockstep?: boolean | null;
        };
        /**
         * ExperimentPage
         * @description Experiments, newest first.
         */
        ExperimentPage: {
            /** Next Cursor */
            next_cursor?: string | null;
            /** Items */
            items: components["schemas"]["Experiment"][];
        };
        /**
         * ExperimentUpdate
         * @description What may change live.
         */
        ExperimentUpdate: {
            /** Name */
            name?: string | null;
            mode?: components["schemas"]["Mode"] | null;
            /** Feedback Timeout */
            feedback_timeout?: number | null;
        };
        /**
         * Feedback
         * @description One trainer's label for one proposal.
         */
        Feedback: {
            /** Id */
            id: number;
            /** Click Id */
            click_id: string;
            /** Proposal Id */
            proposal_id: number;
            /** Experiment Id */
            experiment_id: number;
            /** Trainer */
            trainer: string;
            /** Value */
            value: number;
            status: components["schemas"]["FeedbackStatus"];
            /**
             * Received At
             * Format: date-time
             */
            received_at: string;
            /** Undone At */
            undone_at?: string | null;
        };
        /**
         * FeedbackStatus
         * @description What became of a click: it counted, or it came after the proposal had closed and decides nothing.
         * @enum {string}
         */
        FeedbackStatus: "stored" | "late";
        /**
         * FeedbackStored
         * @description A click is committed. `undoable` says whether it can still be undone.
         */
        FeedbackStored: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "feedback_stored";
            feedback: components["schemas"]["Feedback"];
            /** Undoable */
            undoable: boolean;
        };
        /**
         * FeedbackUndone
         * @description A click was taken back; its proposal is open again (a `proposal_opened` follows).
         */
        FeedbackUndone: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "feedback_undone";
            feedback: components["schemas"]["Feedback"];
        };
        /**
         * FieldProblem
         * @description One wrong field of a request.
         */
        FieldProblem: {
            /** Field */
            field: string;
            /** Message */
            message: string;
        };
        /**
         * FrameHeader
         * @description JSON header of a binary frame: `[u32 big-endian header length][this][JPEG]`.
         */
        FrameHeader: {
            /** Camera */
            camera: string;
            /** Width */
            width: number;
            /** Height */
            height: number;
            /** Taken At */
            taken_at: number;
            /** Execution Id */
            execution_id?: number | null;
        };
        /**
         * GateDecision
         * @description Whether the approved call may run; `reason` is `open`, or what kept it shut, in words.
         */
        GateDecision: {
            /** Allowed */
            allowed: boolean;
            /** Reason */
            reason: string;
        };
        /** HTTPValidationError */
        HTTPValidationError: {
            /** Detail */
            detail?: components["schemas"]["ValidationError"][];
        };
        /**
         * Lifecycle
         * @description Where an experiment is (DESIGN.md section 6). `halted` is a separate, latched flag.
         * @enum {string}
         */
        Lifecycle: "created" | "running" | "paused" | "finished" | "failed" | "archived";
        /**
         * MetricPage
         * @description Metric points, oldest first.
         */
        MetricPage: {
            /** Next Cursor */
            next_cursor?: string | null;
            /** Items */
            items: components["schemas"]["MetricPoint"][];
        };
        /**
         * MetricPoint
         * @description Values at one amount of feedback: successes, predicted feedback, losses, temperatures, ...
         */
        MetricPoint: {
            /** Feedback */
            feedback: number;
            /**
             * At
             * Format: date-time
             */
            at: string;
            /** Values */
            values: {
                [key: string]: number;
            };
        };
        /**
         * MetricsAdded
         * @description A new metric point.
         */
        MetricsAdded: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "metrics_added";
            point: components["schemas"]["MetricPoint"];
        };
        /**
         * Mode
         * @description Whether an approved skill reaches the robot.
         * @enum {string}
         */
        Mode: "propose_only" | "execute_approved";
        /**
         * Overlay
         * @description A proposal drawn for one camera, in pixels of the full-size image (see `robot_adapters.base.CameraOverlay`).
         */
        Overlay: {
            /** Dot */
            dot?: [
                number,
                number
            ] | null;
            /** Line */
            line?: [
                [
                    number,
                    number
                ],
                [
                    number,
                    number
                ]
            ] | null;
            /**
             * Arrow
             * @default false
             */
            arrow: boolean;
            /** Bar */
            bar?: [
                [
                    number,
                    number
                ],
                [
                    number,
                    number
                ]
            ] | null;
            /** Ring */
            ring?: [
                number,
                number
            ] | null;
            /**
             * In View
             * @default true
             */
            in_view: boolean;
        };
        /**
         * Parameter
         * @description A skill's parameter with its bounds.
         */
        Parameter: {
            /** Name */
            name: string;
            /** Unit */
            unit: string;
            /** Low */
            low: number;
            /** High */
            high: number;
            /**
             * Description
             * @default
             */
            description: string;
        };
        /**
         * Phase
         * @description What a running experiment is doing right now.
         * @enum {string}
         */
        Phase: "idle" | "starting" | "observing" | "proposing" | "awaiting_feedback" | "deciding" | "executing" | "learning" | "evaluating";
        /**
         * Pong
         * @description Answer to a ping.
         */
        Pong: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "pong";
        };
        /**
         * Problem
         * @description RFC 9457 problem details, plus `remedy` and, for a wrong body, the fields.
         */
        Problem: {
            /**
             * Type
             * @default about:blank
             */
            type: string;
            /** Title */
            title: string;
            /** Status */
            status: number;
            /** Detail */
            detail: string;
            /** Remedy */
            remedy: string;
            /**
             * Fields
             * @default []
             */
            fields: components["schemas"]["FieldProblem"][];
        } & {
            [key: string]: unknown;
        };
        /**
         * Proposal
         * @description A skill call that the agent suggests for an observation.
         */
        Proposal: {
            /** Id */
            id: number;
            /** Experiment Id */
            experiment_id: number;
            /**
             * Episode
             * @description number of the episode in its experiment, from 1
             */
            episode: number;
            /**
             * Number
             * @description number of the proposal in its experiment, from 1
             */
            number: number;
            /** Observation Id */
            observation_id: string;
            /** State */
            state: number[];
            /** Skill */
            skill: string;
            /** Parameters */
            parameters: {
                [key: string]: number;
            };
            /**
             * Digest
             * @description SHA-256 over skill and parameters; an approval is bound to it
             */
            digest: string;
            /** Predicted Feedback */
            predicted_feedback: number;
            /** Skill Probabilities */
            skill_probabilities: {
                [key: string]: number;
            };
            /** Policy Version */
            policy_version: number;
            /**
             * Subgoal
             * @description what comes next, in words
             */
            subgoal?: string | null;
            /** Views */
            views: components["schemas"]["View"][];
            /**
             * Opened At
             * Format: date-time
             */
            opened_at: string;
            /** Closed At */
            closed_at?: string | null;
            close_reason?: components["schemas"]["CloseReason"] | null;
            verdict?: components["schemas"]["Verdict"] | null;
            gate?: components["schemas"]["GateDecision"] | null;
            /**
             * Purpose
             * @default training
             * @enum {string}
             */
            purpose: "training" | "evaluation";
        };
        /**
         * ProposalClosed
         * @description A proposal is closed; `proposal.verdict`, `.close_reason` and `.gate` say how.
         */
        ProposalClosed: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "proposal_closed";
            proposal: components["schemas"]["Proposal"];
        };
        /**
         * ProposalOpened
         * @description A proposal waits for feedback; it is already stored.
         */
        ProposalOpened: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "proposal_opened";
            proposal: components["schemas"]["Proposal"];
        };
        /**
         * ProposalPage
         * @description Proposals, newest first.
         */
        ProposalPage: {
            /** Next Cursor */
            next_cursor?: string | null;
            /** Items */
            items: components["schemas"]["Proposal"][];
        };
        /**
         * Refused
         * @description Answer to a client's message that could not be taken; nothing changed.
         */
        Refused: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "refused";
            /** Request Id */
            request_id: string | null;
            problem: components["schemas"]["Problem"];
        };
        /**
         * Skill
         * @description A primitive that a task offers.
         */
        Skill: {
            /** Name */
            name: string;
            /** Parameters */
            parameters: components["schemas"]["Parameter"][];
            /**
             * Description
             * @default
             */
            description: string;
        };
        /**
         * Snapshot
         * @description Everything a page needs to draw itself; sent first on every connection, and again after a resync.
         */
        Snapshot: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "snapshot";
            experiment: components["schemas"]["Experiment"];
            /** @description the open proposal, if any */
            proposal?: components["schemas"]["Proposal"] | null;
            /** @description the running execution, if any */
            execution?: components["schemas"]["Execution"] | null;
            /** @description the newest feedback, while it can be undone */
            undoable?: components["schemas"]["Feedback"] | null;
            /**
             * Server Time
             * Format: date-time
             */
            server_time: string;
            /**
             * Boot Id
             * @description changes when the server restarts
             */
            boot_id: string;
        };
        /**
         * TaskInfo
         * @description A task of the catalogue.
         */
        TaskInfo: {
            /** Name */
            name: string;
            /** Title */
            title: string;
            /** Instruction */
            instruction: string;
            /** State */
            state: {
                [key: string]: string | number;
            }[];
            /** Skills */
            skills: components["schemas"]["Skill"][];
            /** Subgoals */
            subgoals: string[];
            /** Horizon */
            horizon: number;
        };
        /** ValidationError */
        ValidationError: {
            /** Location */
            loc: (string | number)[];
            /** Message */
            msg: string;
            /** Error Type */
            type: string;
            /** Input */
            input?: unknown;
            /** Context */
            ctx?: Record<string, never>;
        };
        /**
         * Verdict
         * @description What the trainers' feedback on a proposal adds up to.
         * @enum {string}
         */
        Verdict: "good" | "neutral" | "bad";
        /**
         * View
         * @description One camera's still image of the observation, with the overlay that was computed on it.
         */
        View: {
            /** Camera */
            camera: string;
            /** Width */
            width: number;
            /** Height */
            height: number;
            /**
             * Image
             * @description SHA-256 of the JPEG; the same hash is the same picture
             */
            image: string;
            /**
             * Url
             * @description path of the JPEG below the server's root
             */
            url: string;
            overlay: components["schemas"]["Overlay"];
        };
        /**
         * WorkerChanged
         * @description A worker process started, died or was restarted.
         */
        WorkerChanged: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "worker_changed";
            /**
             * Worker
             * @enum {string}
             */
            worker: "robot" | "learner";
            /**
             * Status
             * @enum {string}
             */
            status: "starting" | "ready" | "died" | "restarted";
            /** Detail */
            detail: string;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export interface operations {
    a_api_v1_experiments_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ExperimentPage"];
                };
            };
        };
    };
    b_api_v1_experiments_post: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ExperimentCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HTTPValidationError"];
                };
            };
        };
    };
    t_api_v1_tasks_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TaskInfo"][];
                };
            };
        };
    };
    t2_api_v1_adapters_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AdapterInfo"][];
                };
            };
        };
    };
    t3_api_v1_algorithms_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["AlgorithmInfo"][];
                };
            };
        };
    };
    m_api_v1_m_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["MetricPage"];
                };
            };
        };
    };
    e_api_v1_e_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["EvaluationPage"];
                };
            };
        };
    };
    e2_api_v1_e_post: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["EvaluationCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Evaluation"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HTTPValidationError"];
                };
            };
        };
    };
    pp_api_v1_e_patch: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ExperimentUpdate"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HTTPValidationError"];
                };
            };
        };
    };
    p_api_v1_p_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Problem"];
                };
            };
        };
    };
    p2_api_v1_p2_get: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["ProposalPage"];
                };
            };
        };
    };
    evstream_post: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Snapshot"] | components["schemas"]["ExperimentChanged"] | components["schemas"]["ProposalOpened"] | components["schemas"]["ProposalClosed"] | components["schemas"]["FeedbackStored"] | components["schemas"]["FeedbackUndone"] | components["schemas"]["ExecutionStarted"] | components["schemas"]["ExecutionEnded"] | components["schemas"]["MetricsAdded"] | components["schemas"]["WorkerChanged"] | components["schemas"]["EvaluationChanged"] | components["schemas"]["Acknowledged"] | components["schemas"]["Refused"] | components["schemas"]["Pong"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": unknown;
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HTTPValidationError"];
                };
            };
        };
    };
    cmclient_post: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ClientFeedback"] | components["schemas"]["ClientUndo"] | components["schemas"]["ClientHalt"] | components["schemas"]["ClientFrameAck"] | components["schemas"]["ClientPing"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": unknown;
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HTTPValidationError"];
                };
            };
        };
    };
    fhframe_post: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FrameHeader"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": unknown;
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["HTTPValidationError"];
                };
            };
        };
    };
}

// Generated from the service's OpenAPI document by `npm run api`; `npm run check` fails where they differ.

export interface paths {
    "/api/v1/tasks": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Tasks
         * @description Tasks with their skills, state and subgoals.
         */
        get: operations["list_tasks"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tasks/{name}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Task
         * @description One task.
         */
        get: operations["get_task"];
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
        /**
         * List Adapters
         * @description Adapters (simulators and robots) with the tasks that they stage.
         */
        get: operations["list_adapters"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/adapters/{name}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Adapter
         * @description One adapter.
         */
        get: operations["get_adapter"];
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
        /**
         * List Algorithms
         * @description Learning algorithms with their presets and the JSON Schema of their settings.
         */
        get: operations["list_algorithms"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/algorithms/{name}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Algorithm
         * @description One algorithm.
         */
        get: operations["get_algorithm"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/teachers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Teachers
         * @description Synthetic trainers that may judge in a person's place, with the JSON Schema of their settings.
         */
        get: operations["list_teachers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/teachers/{name}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Teacher
         * @description One synthetic trainer.
         */
        get: operations["get_teacher"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Experiments
         * @description Experiments, newest first unless told otherwise. A cursor goes on in the order that it came from.
         */
        get: operations["list_experiments"];
        put?: never;
        /**
         * Create Experiment
         * @description Create an experiment. It stays `created` until it is started.
         */
        post: operations["create_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Experiment
         * @description An experiment as it is now.
         */
        get: operations["get_experiment"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        /**
         * Update Experiment
         * @description Change the name, the tags, the mode or the time-out, also while it runs.
         */
        patch: operations["update_experiment"];
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/start": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Start Experiment
         * @description Start a created experiment: its workers start, and the first proposal follows. It runs until it is paused.
         */
        post: operations["start_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/pause": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Pause Experiment
         * @description Pause: a skill that runs comes to its end, an open proposal is withdrawn.
         */
        post: operations["pause_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/resume": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Resume Experiment
         * @description Go on, also after a failure or a restart of the service.
         */
        post: operations["resume_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/finish": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Finish Experiment
         * @description End the training for good. Evaluations stay possible.
         */
        post: operations["finish_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/reset": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Reset Episode
         * @description End the episode of one robot, or of every one, and begin a new one from a fresh start of the task.
         */
        post: operations["reset_episode"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/halt": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Halt Experiment
         * @description Emergency stop: whatever moves stops at once, and nothing moves until someone re-arms. Always allowed.
         */
        post: operations["halt_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/rearm": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Rearm Experiment
         * @description Lift the emergency stop.
         */
        post: operations["rearm_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/archive": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Archive Experiment
         * @description Put an ended experiment away. Its rows stay.
         */
        post: operations["archive_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/evaluate": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Evaluate Experiment
         * @description Run the deterministic policy; it goes on in the background (see the evaluations, or the stream).
         */
        post: operations["evaluate_experiment"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/attendance": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Attend
         * @description Say that you stand at the robot and watch it. Say it again before the time is over: else whatever moves stops.
         */
        put: operations["attend"];
        post?: never;
        /**
         * Leave
         * @description Leave the robot: what moves stops, and nothing moves until somebody attends it again.
         */
        delete: operations["leave"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/recover": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Recover
         * @description Clear a collision reflex, once who attends it has looked. After a user stop only releasing the button helps.
         */
        post: operations["recover"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/home": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Home
         * @description Bring the arm slowly to where it is out of the way: at once, by no proposal, for who attends it only.
         */
        post: operations["home"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/camera-calibration": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Camera Calibration
         * @description What a calibration that goes on has so far, so that a page that was loaded anew goes on with it.
         */
        get: operations["get_camera_calibration"];
        /**
         * Store Camera Calibration
         * @description Keep the result, with what the cameras see now to notice by when one is moved: take board and arm away before.
         */
        put: operations["store_camera_calibration"];
        /**
         * Begin Camera Calibration
         * @description Begin to calibrate the cameras, anew if need be, while the experiment doesn't run. Nothing moves.
         */
        post: operations["begin_camera_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/camera-calibration/looks": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Look For The Board
         * @description See the board through every camera, and keep the pose if asked to and it is worth it.
         */
        post: operations["look_for_the_board"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/camera-calibration/solution": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Solve Camera Calibration
         * @description Calculate where the cameras are, and what that is worth. Nothing is stored yet.
         */
        post: operations["solve_camera_calibration"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/proposals": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Proposals
         * @description Proposals of an experiment, newest first.
         */
        get: operations["list_proposals"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/next": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Next Proposal
         * @description The proposal that this trainer is to judge: of all robots and slots, theirs for a while; asked again, renewed.
         *
         *     A page hears of it by the stream; this is for clients without one. Whoever asks is there, as long as they go on.
         */
        post: operations["next_proposal"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals/{proposal_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Proposal
         * @description One proposal.
         */
        get: operations["get_proposal"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals/{proposal_id}/images/{camera}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Image
         * @description The very still image that a proposal's overlay was computed on. It never changes: cache it for good.
         */
        get: operations["get_image"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals/{proposal_id}/feedback": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Feedback Of Proposal
         * @description Feedback on one proposal, newest first; others' only once it is closed. Whose it is: to operators.
         */
        get: operations["list_feedback_of_proposal"];
        put?: never;
        /**
         * Give Feedback
         * @description One click. It is answered after it is stored; a late one is kept, decides nothing, and is answered 409.
         *
         *     One on a proposal that another's approval closed while its trainer had it before them is `overtaken`: it trains.
         */
        post: operations["give_feedback"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/feedback": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Feedback
         * @description Feedback of an experiment, newest first, late and undone included; without others' on what is still open.
         *
         *     One trainer's alone with `trainer`: one's own, or anybody's where an operator asks.
         */
        get: operations["list_feedback"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/feedback/{feedback_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Feedback
         * @description One click as it is stored; somebody else's on an open proposal only once that is closed.
         */
        get: operations["get_feedback"];
        put?: never;
        post?: never;
        /**
         * Undo Feedback
         * @description Take back a trainer's newest click, while nothing has moved; its proposal is open again.
         */
        delete: operations["undo_feedback"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/feedback/{feedback_id}/relabels": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Relabel Feedback
         * @description Correct one's own click on a closed proposal, however old. The learner follows; no verdict or motion changes.
         */
        post: operations["relabel_feedback"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/history": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List History
         * @description Closed proposals, each with its clicks and its execution.
         */
        get: operations["list_history"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/timeline": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Timeline
         * @description Labels on closed proposals over time, and the motions among them: counted, whoever gave them.
         */
        get: operations["get_timeline"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/episodes": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Episodes
         * @description Episodes with what happened in each, counted; newest first.
         */
        get: operations["list_episodes"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/episodes/{number}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Episode
         * @description One episode; its steps are the history with `episode` and `order=asc`.
         */
        get: operations["get_episode"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/executions/{execution_id}/reports": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Report Execution
         * @description Say what an execution did, where the robot can't tell by itself. Its own outcome and the counters stay.
         */
        post: operations["report_execution"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/executions/{execution_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Execution
         * @description One execution.
         */
        get: operations["get_execution"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/incidents": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Incidents
         * @description Safety violations and emergency stops, newest first, each with its video.
         */
        get: operations["list_incidents"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/incidents/{incident_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Incident
         * @description One incident.
         */
        get: operations["get_incident"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/incidents/{incident_id}/frames/{index}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Incident Frame
         * @description One picture of an incident's video. It never changes: cache it for good.
         */
        get: operations["get_incident_frame"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Me
         * @description Who asks, and whether anybody has to sign in here; without a name: not signed in.
         */
        get: operations["get_me"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/sign-in": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Sign In
         * @description Come in by an invitation's token, or by one's own. A page gets a cookie, a program asks for a bearer token.
         */
        post: operations["sign_in"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/sign-out": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Sign Out
         * @description End this session; what it has open is closed.
         */
        post: operations["sign_out"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/me/tokens": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Make Token
         * @description A token for a program that acts in one's own name: `Authorization: Bearer`. It is told this once.
         */
        post: operations["make_token"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/invitations": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Invitations
         * @description Every invitation, newest first; the tokens themselves are not kept.
         */
        get: operations["list_invitations"];
        put?: never;
        /**
         * Invite
         * @description Make a link that lets people in. Nobody gives away more than they may themselves.
         */
        post: operations["invite"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/invitations/{invitation_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Revoke Invitation
         * @description Let nobody in by it any more.
         */
        delete: operations["revoke_invitation"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/people": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List People
         * @description Everybody who was let in, newest first, and where they are on-line.
         */
        get: operations["list_people"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/people/{person_id}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        post?: never;
        /**
         * Revoke Person
         * @description Let somebody out: every session and token of theirs ends, and what they have open is closed at once.
         */
        delete: operations["revoke_person"];
        options?: never;
        head?: never;
        /**
         * Update Person
         * @description Give somebody another role; their open pages begin anew with it, and what they attend is attended no longer.
         */
        patch: operations["update_person"];
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/people": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Present
         * @description Who is on-line in an experiment now.
         */
        get: operations["list_present"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/audit": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Audit
         * @description Every decision: who, what, when, from which session; newest first. Nothing in it is ever changed or deleted.
         */
        get: operations["list_audit"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/exports/audit": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Audit
         * @description The same as CSV, oldest first.
         */
        get: operations["export_audit"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/executions": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Executions
         * @description Executions, newest first.
         */
        get: operations["list_executions"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/metrics": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Metrics
         * @description Metric points by amount of feedback, oldest first.
         */
        get: operations["list_metrics"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/events": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Events
         * @description The journal, oldest first. Which answers are known is told to operators only.
         */
        get: operations["list_events"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/evaluations": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Evaluations
         * @description Evaluations, newest first.
         */
        get: operations["list_evaluations"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/checkpoints": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Checkpoints
         * @description Saved learners, newest first.
         */
        get: operations["list_checkpoints"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/trainers": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Trainers
         * @description Everyone who has judged: people and teachers.
         */
        get: operations["list_trainers"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/curves": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Curves
         * @description Everything that changed in an experiment, as charts.
         */
        get: operations["get_curves"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/exports/metrics": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Metrics
         * @description Every metric point, one a label: what the learner reported and what was counted by then.
         */
        get: operations["export_metrics"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/comparison": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Compare Experiments
         * @description One measure of several experiments: a curve each, or mean and standard error of those that are alike.
         */
        get: operations["compare_experiments"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/paper-figures": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Paper Figures
         * @description What the paper's own figures and its safety table show.
         */
        get: operations["get_paper_figures"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/tags": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Tags
         * @description Every tag in use; for those invited to one experiment, its own.
         */
        get: operations["list_tags"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/calibration": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Calibration
         * @description Reliability curve of the predicted feedback, as it was predicted when each proposal was made.
         */
        get: operations["get_calibration"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/auto-approval": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Auto Approval
         * @description What the critic approved by itself, and how often trainers agreed where it was checked.
         */
        get: operations["get_auto_approval"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals/{proposal_id}/critic": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Critic Map
         * @description What the critic expects of a skill all over the table, in this proposal's situation, and what was said nearby.
         */
        get: operations["get_critic_map"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals/{proposal_id}/considered": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Considered
         * @description What the agent would do with each skill in this proposal's situation: with which parameters, and where.
         */
        get: operations["get_considered"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/quality": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Quality
         * @description Everybody's figures, and how far trainers agree.
         */
        get: operations["get_quality"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/quality/mine": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Own Figures
         * @description One's own figures. Known answers are told after each fifty clicks, so that none is given away.
         */
        get: operations["get_own_figures"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/gold": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Gold
         * @description Closed proposals whose answer was known before they were shown, with everybody's answer; newest first.
         */
        get: operations["list_gold"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/proposals/{proposal_id}/gold": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        /**
         * Mark Gold
         * @description Know the answer to a closed proposal: at the experiment's `gold_rate` it is shown again, among the others.
         */
        put: operations["mark_gold"];
        post?: never;
        /**
         * Unmark Gold
         * @description Show a marked proposal no more.
         */
        delete: operations["unmark_gold"];
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/exports/feedback": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Export Feedback
         * @description Every click with its history: corrections, late ones, those taken back, can't tell, gold, practice.
         */
        get: operations["export_feedback"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/experiments/{experiment_id}/practice": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Practice
         * @description How a trainer does in practice, what is required, and whether their clicks count.
         */
        get: operations["get_practice"];
        put?: never;
        /**
         * Next Practice
         * @description The practice proposal that waits for this trainer; a new one where none does. Asked again, it is the same one.
         */
        post: operations["next_practice"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/practice/{practice_id}/answer": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Answer Practice
         * @description Judge it, and hear at once what was right and why. The same answer again gets the same correction.
         */
        post: operations["answer_practice"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/practice/{practice_id}/images/{camera}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Practice Image
         * @description The picture that a practice proposal is drawn on.
         */
        get: operations["get_practice_image"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/studies": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * List Studies
         * @description Every study in the data directory, newest first, as far as it is now.
         */
        get: operations["list_studies"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/studies/{name}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Study
         * @description One study with its runs and its curves so far, the paper's beside them.
         */
        get: operations["get_study"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/api/v1/studies/{name}/files/{file}": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Get Study File
         * @description A figure (PNG or SVG) or table of a study; `files` of the study names them.
         */
        get: operations["get_study_file"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/health": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Health
         * @description The process is up and its event loop turns.
         */
        get: operations["health"];
        put?: never;
        post?: never;
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "/ready": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        /**
         * Ready
         * @description Whether the database answers and the workers that should live do; why not is told to those who are in.
         */
        get: operations["ready"];
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
    "stream-event": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Any event of the stream (text message)
         * @description What the server sends as text messages, told apart by `type`.
         */
        post: operations["stream_eventstream_event_post"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-frame": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Header of a live picture (binary message)
         * @description A binary message is `[u32 big-endian header length][this as JSON][JPEG]`; answer it with `frame_ack`.
         */
        post: operations["stream_framestream_frame_post"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-message": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Any message of a client
         * @description What a client may send as text messages, told apart by `type`.
         */
        post: operations["stream_messagestream_message_post"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/snapshot": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event snapshot
         * @description Everything a page needs to draw itself: the first message of a connection that doesn't go on where one ended.
         *
         *     Its `seq` is that of the last event before it.
         */
        post: operations["event_snapshot"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/resumed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event resumed
         * @description The first message of a connection that goes on where one ended: the missed events follow, none is missing.
         */
        post: operations["event_resumed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/experiment_changed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event experiment_changed
         * @description Lifecycle, phase, mode, halt or counters changed.
         */
        post: operations["event_experiment_changed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/proposal_opened": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event proposal_opened
         * @description A proposal waits for feedback; it is already stored.
         */
        post: operations["event_proposal_opened"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/proposal_changed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event proposal_changed
         * @description Somebody has voted on an open proposal, or its electorate is another; what was said is told once it is closed.
         */
        post: operations["event_proposal_changed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/proposal_closed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event proposal_closed
         * @description A proposal is closed; `proposal.verdict`, `.close_reason` and `.gate` say how.
         */
        post: operations["event_proposal_closed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/judges_changed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event judges_changed
         * @description Who is there to judge, and which open proposal each has before them.
         */
        post: operations["event_judges_changed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/feedback_stored": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event feedback_stored
         * @description A click is committed, and its proposal closed by it. `undoable` says whether it can still be undone.
         *
         *     While others are still asked, only who has clicked is told (`proposal_changed`), and the answer goes to them.
         */
        post: operations["event_feedback_stored"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/feedback_undone": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event feedback_undone
         * @description A click was taken back; its proposal is open again (a `proposal_opened` follows).
         */
        post: operations["event_feedback_undone"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/feedback_relabelled": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event feedback_relabelled
         * @description A click on a closed proposal was corrected: the learner follows, its verdict and what moved by it stay.
         */
        post: operations["event_feedback_relabelled"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/execution_started": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event execution_started
         * @description The robot moves; frames follow.
         */
        post: operations["event_execution_started"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/execution_ended": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event execution_ended
         * @description The robot stands still again.
         */
        post: operations["event_execution_ended"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/metrics_added": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event metrics_added
         * @description A new metric point.
         */
        post: operations["event_metrics_added"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/worker_changed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event worker_changed
         * @description A worker process started, died or was restarted.
         */
        post: operations["event_worker_changed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/robot_told": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event robot_told
         * @description What a robot told of itself when it was looked at, or stood still again; while it moves, frames carry it.
         */
        post: operations["event_robot_told"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/attendance_changed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event attendance_changed
         * @description Somebody attends the real robot from now on, or nobody does any more: then it stands still.
         */
        post: operations["event_attendance_changed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/incident_kept": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event incident_kept
         * @description A safety violation or an emergency stop was written down with its video: see `GET incidents/{id}`.
         */
        post: operations["event_incident_kept"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/evaluation_changed": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event evaluation_changed
         * @description An evaluation started, went on or ended.
         */
        post: operations["event_evaluation_changed"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/acknowledged": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event acknowledged
         * @description Answer to a client's message; for feedback it comes after the commit.
         */
        post: operations["event_acknowledged"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/refused": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event refused
         * @description Answer to a client's message that could not be taken; nothing changed.
         */
        post: operations["event_refused"];
        delete?: never;
        options?: never;
        head?: never;
        patch?: never;
        trace?: never;
    };
    "stream-event/pong": {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        get?: never;
        put?: never;
        /**
         * Event pong
         * @description Answer to a ping; without one: say something, nothing was heard of you for a while.
         */
        post: operations["event_pong"];
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
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
            feedback: components["schemas"]["Feedback"] | null;
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
        Aggregation: "first" | "majority" | "unanimous" | "weighted";
        /**
         * AgreementInfo
         * @description Krippendorff's alpha, ordinal over bad, neutral and good; late clicks count, who can't tell is missing.
         */
        AgreementInfo: {
            /**
             * Alpha
             * @description 1: perfect; 0: as by chance; null: see `why`
             */
            alpha: number | null;
            /**
             * Proposals
             * @description judged by two trainers or more
             */
            proposals: number;
            /** Labels */
            labels: number;
            /** Trainers */
            trainers: number;
            /**
             * Why
             * @description what is missing before it can be told
             */
            why: string | null;
        };
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
         * AttendanceChanged
         * @description Somebody attends the real robot from now on, or nobody does any more: then it stands still.
         */
        AttendanceChanged: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "attendance_changed";
            /**
             * Operator
             * @description who attends it; null: nobody
             */
            operator: string | null;
        };
        /**
         * Attending
         * @description An operator stands at the robot and watches it, for so long unless it is said again.
         */
        Attending: {
            /**
             * Operator
             * @description who attends the robot
             * @example anna
             */
            operator: string;
            /**
             * Seconds
             * @description until it has to be said again
             * @default 5
             */
            seconds: number;
        };
        /**
         * AuditEntry
         * @description One decision. `session_id` null: nobody has to sign in, or the service did it by itself.
         */
        AuditEntry: {
            /** Id */
            id: number;
            /**
             * At
             * Format: date-time
             */
            at: string;
            /** Name */
            name: string;
            /** Role */
            role: string;
            /** Person Id */
            person_id: number | null;
            /** Session Id */
            session_id: number | null;
            /** Experiment Id */
            experiment_id: number | null;
            /** Action */
            action: string;
            /** Subject */
            subject: {
                [key: string]: unknown;
            };
        };
        /**
         * AuditPage
         * @description Decisions, newest first.
         */
        AuditPage: {
            /** Items */
            items: components["schemas"]["AuditEntry"][];
            /** Next Cursor */
            next_cursor: string | null;
        };
        /**
         * AutoApproval
         * @description When the critic may approve a proposal by itself. Simulated robots only; the critics must be two or more.
         */
        AutoApproval: {
            /**
             * Predicted At Least
             * @description least predicted feedback
             * @default 0.9
             */
            predicted_at_least: number;
            /**
             * Uncertainty At Most
             * @description most disagreement of the critics
             * @default 0.1
             */
            uncertainty_at_most: number;
            /**
             * After Feedback
             * @description feedback that must be stored before
             * @default 50
             */
            after_feedback: number;
            /**
             * Audit Every
             * @description one of so many qualifying proposals goes to a trainer anyway; 1: all of them
             * @default 10
             */
            audit_every: number;
            /**
             * Agreement At Least
             * @description share of audited proposals that trainers must call good; suspended once the 95 % interval of the newest audits lies below it
             * @default 0.9
             */
            agreement_at_least: number;
        };
        /**
         * AutoApprovalRecord
         * @description What the critic approved by itself, and what trainers said of the proposals that were held back to check it.
         */
        AutoApprovalRecord: {
            /** Experiment Id */
            experiment_id: number;
            /** @description null: off */
            rule: components["schemas"]["AutoApproval"] | null;
            /**
             * Suspended
             * @description why auto-approval has suspended itself; setting it anew lifts it
             */
            suspended: string | null;
            /**
             * Approved
             * @description motions by the critic's own approval, since the experiment began
             */
            approved: number;
            /**
             * Audited
             * @description newest audits that trainers judged, since the rule was set
             */
            audited: number;
            /**
             * Agreed
             * @description those of them that trainers called good
             */
            agreed: number;
            /**
             * Agreement
             * @description agreed / audited; null before the first audit
             */
            agreement: number | null;
            /**
             * Interval
             * @description Wilson's 95 % interval of the agreement
             */
            interval: [
                number,
                number
            ];
        };
        /**
         * Calibration
         * @description Reliability curve of the critic: what it predicted when it proposed, against the first label that followed.
         */
        Calibration: {
            /** Experiment Id */
            experiment_id: number;
            /**
             * Labels
             * @description labels that the curve is made of
             */
            labels: number;
            /**
             * Needed
             * @description labels before which the curve says nothing
             */
            needed: number;
            /**
             * Error
             * @description expected calibration error in units of feedback; null with fewer labels than needed
             */
            error: number | null;
            /**
             * Bins
             * @description ascending; empty ones are left out
             */
            bins: components["schemas"]["CalibrationBin"][];
        };
        /**
         * CalibrationBin
         * @description Predictions between `low` and `high`: how many, their mean, and the mean of the labels that followed.
         */
        CalibrationBin: {
            /** Low */
            low: number;
            /** High */
            high: number;
            /** Count */
            count: number;
            /** Predicted */
            predicted: number;
            /** Label */
            label: number;
        };
        /**
         * CatchingUp
         * @description How far a learner that has started anew is with the stored labels. It may propose before it has them all.
         */
        CatchingUp: {
            /** Taken */
            taken: number;
            /** Of */
            of: number;
        };
        /**
         * Chart
         * @description Lines that belong into one picture.
         */
        Chart: {
            /**
             * Name
             * @description what is measured; for an algorithm's own metric its name
             */
            name: string;
            /**
             * Axis
             * @enum {string}
             */
            axis: "feedback" | "low_level_steps" | "proposals" | "decisions";
            /** Curves */
            curves: components["schemas"]["Curve"][];
        };
        /**
         * Checkpoint
         * @description A saved learner.
         */
        Checkpoint: {
            /** Id */
            id: number;
            /** Experiment Id */
            experiment_id: number;
            /** Policy Version */
            policy_version: number;
            /** Last Feedback Id */
            last_feedback_id: number;
            /** Sha256 */
            sha256: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
        };
        /**
         * CheckpointPage
         * @description Checkpoints, newest first.
         */
        CheckpointPage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Checkpoint"][];
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
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * Trainer
             * @default local
             */
            trainer: string;
            /**
             * Estimate Shown
             * @description whether the page showed the predicted feedback when it was clicked; null: it wasn't told
             */
            estimate_shown?: boolean | null;
            looked?: components["schemas"]["Looked"] | null;
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
         * ClientLook
         * @description The trainer of this connection looks at their proposal: it stays theirs.
         */
        ClientLook: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "look";
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
            /**
             * Regular
             * @description I say something at least every five seconds from now on, and am gone where I don't
             * @default false
             */
            regular: boolean;
        };
        /**
         * ClientRelabel
         * @description Correct a click on a closed proposal. It never causes a motion and never changes a verdict.
         */
        ClientRelabel: {
            /**
             * Click Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            click_id: string;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * Trainer
             * @default local
             */
            trainer: string;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "relabel";
            /** Feedback Id */
            feedback_id: number;
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
         * @description Why a proposal is no longer open. `cant_tell`: nobody could tell from the views, so there is no verdict.
         *
         *     `superseded`: another one for the same state was approved, and the robot moves by that; votes on it still train.
         * @enum {string}
         */
        CloseReason: "judged" | "cant_tell" | "superseded" | "timed_out" | "withdrawn" | "interrupted";
        /**
         * ComparedCurve
         * @description The mean of several experiments at common points, or one experiment; sem: the standard error of that mean.
         */
        ComparedCurve: {
            /** Label */
            label: string;
            /** Experiments */
            experiments: number[];
            /** X */
            x: number[];
            /** Mean */
            mean: number[];
            /** Sem */
            sem: (number | null)[];
        };
        /**
         * Comparison
         * @description Curves of several experiments in one picture. missing: experiments that have none of this yet.
         */
        Comparison: {
            /**
             * Measure
             * @enum {string}
             */
            measure: "successes" | "success_rate" | "violation_ratio" | "good_share" | "critic_loss" | "estimate_error";
            /**
             * Axis
             * @enum {string}
             */
            axis: "feedback" | "low_level_steps" | "proposals" | "decisions";
            /** Curves */
            curves: components["schemas"]["ComparedCurve"][];
            /** Missing */
            missing: number[];
        };
        /**
         * Considered
         * @description What the agent would do with one skill. Overlays are there while the proposal is open and its robot looks on.
         */
        Considered: {
            /** Skill */
            skill: string;
            /**
             * Probability
             * @description of the skill, when the proposal was made
             */
            probability: number;
            /**
             * Parameters
             * @description m and rad, robot base frame
             */
            parameters: {
                [key: string]: number;
            };
            /** Predicted Feedback */
            predicted_feedback: number;
            /**
             * Proposed
             * @description it is the proposal itself
             */
            proposed: boolean;
            /**
             * Overlays
             * @description by camera, in pixels of the proposal's pictures
             */
            overlays: {
                [key: string]: components["schemas"]["Overlay"];
            };
        };
        /**
         * ConsideredList
         * @description What the agent would do with each skill in one proposal's situation, the likeliest skill first.
         */
        ConsideredList: {
            /** Proposal Id */
            proposal_id: number;
            /**
             * Policy Version
             * @description gradient steps that the agent had taken when it was asked
             */
            policy_version: number;
            /** Items */
            items: components["schemas"]["Considered"][];
        };
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
             * Cant Tell
             * @description answers that nothing can be told from the view; no feedback
             * @default 0
             */
            cant_tell: number;
            /**
             * Late
             * @default 0
             */
            late: number;
            /**
             * Relabelled
             * @description corrections of closed proposals' clicks
             * @default 0
             */
            relabelled: number;
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
            /**
             * Auto Approved
             * @default 0
             */
            auto_approved: number;
        };
        /**
         * CriticMap
         * @description The predicted feedback of one skill over the table, in one proposal's situation. Lengths in m, base frame.
         */
        CriticMap: {
            /** Experiment Id */
            experiment_id: number;
            /** Proposal Id */
            proposal_id: number;
            /** Skill */
            skill: string;
            /**
             * X
             * @description of the columns, ascending
             */
            x: number[];
            /**
             * Y
             * @description of the rows, ascending
             */
            y: number[];
            /**
             * Values
             * @description a row for each y, a value for each x
             */
            values: number[][];
            /**
             * Others
             * @description the skill's other parameters, the same everywhere
             */
            others: {
                [key: string]: number;
            };
            /** Labels */
            labels: components["schemas"]["NearbyLabel"][];
            /**
             * Keypoints
             * @description where the skill acts on objects, as the task tells
             */
            keypoints: [
                number,
                number,
                number
            ][];
            /**
             * Policy Version
             * @description gradient steps that this critic had taken
             */
            policy_version: number;
            /**
             * Source
             * @description asked as it learns, or read from its newest checkpoint
             * @enum {string}
             */
            source: "learner" | "checkpoint";
        };
        /**
         * Curve
         * @description One line. y is null where nothing was measured; low and high are the ends of a band, where there is one.
         */
        Curve: {
            /** Name */
            name: string;
            /** X */
            x: number[];
            /** Y */
            y: (number | null)[];
            /** Low */
            low: (number | null)[] | null;
            /** High */
            high: (number | null)[] | null;
        };
        /**
         * Curves
         * @description Everything that changed in an experiment, oldest first in each curve.
         */
        Curves: {
            /** Experiment Id */
            experiment_id: number;
            /**
             * Feedback
             * @description labels behind them
             */
            feedback: number;
            /** Charts */
            charts: components["schemas"]["Chart"][];
        };
        /**
         * Episode
         * @description From one reset to the next. outcome is null while it goes on.
         */
        Episode: {
            /**
             * Number
             * @description in its experiment, from 1
             */
            number: number;
            /**
             * Robot
             * @description which robot of the experiment, from 0
             */
            robot: number;
            /**
             * Purpose
             * @enum {string}
             */
            purpose: "training" | "evaluation";
            /** Outcome */
            outcome: ("success" | "horizon" | "violation" | "reset" | "interrupted") | null;
            /** Seed */
            seed: number;
            /**
             * Started At
             * Format: date-time
             */
            started_at: string;
            /** Ended At */
            ended_at: string | null;
            /** Proposals */
            proposals: number;
            /** Executions */
            executions: number;
            /** Violations */
            violations: number;
        };
        /**
         * EpisodePage
         * @description Episodes, newest first.
         */
        EpisodePage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Episode"][];
        };
        /**
         * Estimate
         * @description How often a trainer is right, estimated from everybody's labels and from known answers.
         */
        Estimate: {
            /**
             * Accuracy
             * @description share of labels expected to be true; null: nothing to compare them with
             */
            accuracy: number | null;
            /**
             * Interval
             * @description 95 % interval of that share
             */
            interval: [
                number,
                number
            ] | null;
            /**
             * Informative
             * @description good and bad labels that others, or a known answer, can be held to
             */
            informative: number;
            /**
             * Weight
             * @description what `weighted` counts; 2/3 for a trainer of whom nothing is known
             */
            weight: number;
            /**
             * At
             * @description when it was estimated; null: not yet
             */
            at: string | null;
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
            ended_at: string | null;
        };
        /**
         * EvaluationChanged
         * @description An evaluation started, went on or ended.
         */
        EvaluationChanged: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Evaluation"][];
        };
        /**
         * EventPage
         * @description Journal lines, oldest first.
         */
        EventPage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["StoredEvent"][];
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
            /**
             * Robot
             * @description which robot of the experiment, from 0
             */
            robot: number;
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
            ended_at: string | null;
            outcome: components["schemas"]["ExecutionOutcome"] | null;
            /**
             * End Reason
             * @description arrived, timeout, stalled, force_limit, stopped, ...
             */
            end_reason: string | null;
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
            /**
             * Violations
             * @default []
             */
            violations: components["schemas"]["Violation"][];
            /**
             * Reports
             * @description what people saw, oldest first; the newest counts
             * @default []
             */
            reports: components["schemas"]["Report"][];
        };
        /**
         * ExecutionEnded
         * @description The robot stands still again.
         */
        ExecutionEnded: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
         * ExecutionPage
         * @description Executions, newest first.
         */
        ExecutionPage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Execution"][];
        };
        /**
         * ExecutionStarted
         * @description The robot moves; frames follow.
         */
        ExecutionStarted: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
            /** Num Envs */
            num_envs: number;
            /** Seed */
            seed: number;
            mode: components["schemas"]["Mode"];
            aggregation: components["schemas"]["Aggregation"];
            /** Feedback Timeout */
            feedback_timeout: number | null;
            /** Teacher */
            teacher: string | null;
            /** Teacher Settings */
            teacher_settings: {
                [key: string]: unknown;
            };
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
            failure: string | null;
            /** @description while a learner that has started anew takes the stored labels */
            catching_up: components["schemas"]["CatchingUp"] | null;
            auto_approval: components["schemas"]["AutoApproval"] | null;
            /**
             * Auto Approval Suspended
             * @description why auto-approval has suspended itself; setting it anew lifts it
             */
            auto_approval_suspended: string | null;
            /**
             * Gold Rate
             * @default 0
             */
            gold_rate: number;
            practice_required: components["schemas"]["PracticeRequired"] | null;
            /**
             * @default {
             *       "parallel": false,
             *       "weighted_approves": false,
             *       "least": 1,
             *       "lease_seconds": 60,
             *       "vanish_seconds": 10,
             *       "finish_seconds": 20
             *     }
             */
            together: components["schemas"]["Together"];
            /**
             * Tags
             * @default []
             */
            tags: string[];
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
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
             * @default {}
             */
            settings: {
                [key: string]: unknown;
            };
            /**
             * Adapter Settings
             * @description the adapter's settings
             * @default {}
             */
            adapter_settings: {
                [key: string]: unknown;
            };
            /**
             * Num Envs
             * @description simulated robots at once, each in a process; they share the learner
             * @default 1
             */
            num_envs: number;
            /**
             * Seed
             * @default 0
             */
            seed: number;
            /** @description null: simulated robots execute what is approved, real ones propose only */
            mode?: components["schemas"]["Mode"] | null;
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
             * Teacher Settings
             * @description the teacher's settings; see GET /api/v1/teachers
             * @default {}
             */
            teacher_settings: {
                [key: string]: unknown;
            };
            /**
             * Lockstep
             * @description true: owed gradient steps are worked off before the next proposal, so a run can be repeated exactly; false: they run while the human thinks; null: true with a teacher, else false
             */
            lockstep?: boolean | null;
            auto_approval?: components["schemas"]["AutoApproval"] | null;
            /**
             * Gold Rate
             * @description share of proposals whose answer is known beforehand: they measure trainers, look like all others, are never executed and never learned from; 0 turns it off
             * @default 0
             */
            gold_rate: number;
            practice_required?: components["schemas"]["PracticeRequired"] | null;
            /**
             * @default {
             *       "parallel": false,
             *       "weighted_approves": false,
             *       "least": 1,
             *       "lease_seconds": 60,
             *       "vanish_seconds": 10,
             *       "finish_seconds": 20
             *     }
             */
            together: components["schemas"]["Together"];
            /**
             * Tags
             * @description words to find it by; any, without a comma, up to 40 characters each
             * @default []
             */
            tags: string[];
        };
        /**
         * ExperimentPage
         * @description Experiments, newest first.
         */
        ExperimentPage: {
            /** Next Cursor */
            next_cursor: string | null;
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
            aggregation?: components["schemas"]["Aggregation"] | null;
            /** Feedback Timeout */
            feedback_timeout?: number | null;
            auto_approval?: components["schemas"]["AutoApproval"] | null;
            /** Gold Rate */
            gold_rate?: number | null;
            practice_required?: components["schemas"]["PracticeRequired"] | null;
            together?: components["schemas"]["TogetherUpdate"] | null;
            /**
             * Tags
             * @description all of them: one that is left out is taken off
             */
            tags?: string[] | null;
        };
        /**
         * Feedback
         * @description One trainer's label for one proposal. A correction changes `label`, and neither `value` nor the verdict.
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
            /**
             * Value
             * @description as it was clicked, and as it counted for the verdict
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * Label
             * @description what it counts as now: in the counters, and for the learner
             * @enum {unknown}
             */
            label: -1 | 0 | 1 | "cant_tell";
            /**
             * Relabels
             * @description every correction, oldest first
             */
            relabels: components["schemas"]["Relabel"][];
            status: components["schemas"]["FeedbackStatus"];
            /**
             * Received At
             * Format: date-time
             */
            received_at: string;
            /** Undone At */
            undone_at: string | null;
            /**
             * Estimate Shown
             * @description whether the page showed the predicted feedback when it was clicked; null: it wasn't told
             */
            estimate_shown: boolean | null;
            /**
             * Late Because
             * @description why it decides nothing; told to its sender
             */
            late_because: string | null;
        };
        /**
         * FeedbackCreate
         * @description One click.
         */
        FeedbackCreate: {
            /**
             * Click Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            click_id: string;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * Trainer
             * @default local
             */
            trainer: string;
            /**
             * Estimate Shown
             * @description whether the page showed the predicted feedback when it was clicked; null: it wasn't told
             */
            estimate_shown?: boolean | null;
            looked?: components["schemas"]["Looked"] | null;
        };
        /**
         * FeedbackPage
         * @description Feedback, newest first.
         */
        FeedbackPage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Feedback"][];
        };
        /**
         * FeedbackRelabelled
         * @description A click on a closed proposal was corrected: the learner follows, its verdict and what moved by it stay.
         */
        FeedbackRelabelled: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "feedback_relabelled";
            feedback: components["schemas"]["Feedback"];
        };
        /**
         * FeedbackStatus
         * @description What became of a click: it counted, it came after the proposal had closed, or its trainer has to practise first.
         *
         *     `overtaken`: another proposal was approved while its trainer looked at this one. It is counted and trains as any
         *     other, and decides nothing. Late ones and those of practice are kept, and decide and teach nothing.
         * @enum {string}
         */
        FeedbackStatus: "stored" | "overtaken" | "late" | "practice";
        /**
         * FeedbackStored
         * @description A click is committed, and its proposal closed by it. `undoable` says whether it can still be undone.
         *
         *     While others are still asked, only who has clicked is told (`proposal_changed`), and the answer goes to them.
         */
        FeedbackStored: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "feedback_undone";
            feedback: components["schemas"]["TakenBack"];
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
            /**
             * Robot
             * @description which robot of the experiment, from 0
             * @default 0
             */
            robot: number;
            /** Camera */
            camera: string;
            /** Width */
            width: number;
            /** Height */
            height: number;
            /** Taken At */
            taken_at: number;
            /** Execution Id */
            execution_id: number | null;
            /** @description in some of them; five a second */
            telemetry: components["schemas"]["Telemetry"] | null;
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
        /**
         * Gold
         * @description A proposal whose answer was known before it was shown; told of only once it is closed.
         */
        Gold: {
            /** Proposal Id */
            proposal_id: number;
            /** Number */
            number: number;
            /** Skill */
            skill: string;
            /**
             * Known Answer
             * @description -1 bad, +1 good
             */
            known_answer: number;
            /**
             * Source
             * @description the task's rule, or an operator's mark
             * @enum {string}
             */
            source: "rule" | "operator";
            /** Answers */
            answers: components["schemas"]["GoldAnswer"][];
        };
        /**
         * GoldAnswer
         * @description What one trainer said of a proposal whose answer was known.
         */
        GoldAnswer: {
            /** Trainer */
            trainer: string;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /** Right */
            right: boolean;
        };
        /**
         * GoldMark
         * @description An operator knows the answer to a closed proposal.
         */
        GoldMark: {
            /**
             * Answer
             * @description -1 bad, +1 good
             * @enum {integer}
             */
            answer: -1 | 1;
            /**
             * Trainer
             * @description who says so
             * @default local
             */
            trainer: string;
        };
        /**
         * GoldPage
         * @description Closed proposals whose answer was known, newest first.
         */
        GoldPage: {
            /** Items */
            items: components["schemas"]["Gold"][];
            /** Next Cursor */
            next_cursor: string | null;
        };
        /**
         * GuideBegin
         * @description What to begin a calibration with.
         */
        GuideBegin: {
            /**
             * Square Mm
             * @description edge of a square of the printed board, mm
             * @default 36
             */
            square_mm: number;
            /**
             * Wanted
             * @description poses to take of each camera
             * @default 15
             */
            wanted: number;
        };
        /**
         * GuideCamera
         * @description What one camera sees now.
         */
        GuideCamera: {
            /**
             * Camera
             * @example left
             */
            camera: string;
            /**
             * Found
             * @description whether the board is in the picture
             */
            found: boolean;
            /**
             * Taken
             * @description poses taken so far
             */
            taken: number;
            /**
             * Jpeg
             * @description the picture with the corners that were found: a JPEG in Base64
             */
            jpeg: string;
        };
        /**
         * GuideCameraResult
         * @description What the calibration of one camera is worth.
         */
        GuideCameraResult: {
            /** Camera */
            camera: string;
            /**
             * Error Mm
             * @description of poses that had no part in the result, median
             */
            error_mm: number;
            /**
             * Poses
             * @description that the result is made from
             */
            poses: number;
            /**
             * Left Out
             * @description poses that contradict the rest
             */
            left_out: number;
            /**
             * Good
             * @description whether the error is 3 mm at most
             */
            good: boolean;
        };
        /**
         * GuideOutcome
         * @description What a calibration is worth, and whether it is kept.
         */
        GuideOutcome: {
            /** Cameras */
            cameras: components["schemas"]["GuideCameraResult"][];
            /**
             * Apart Mm
             * @description between where two cameras place the board; null with one
             */
            apart_mm: number | null;
            /** Stored */
            stored: boolean;
        };
        /**
         * GuideState
         * @description A calibration that goes on: what its cameras see now, and what it is worth once that is calculated.
         */
        GuideState: {
            /** @description null where none goes on */
            step: components["schemas"]["GuideStep"] | null;
            /** @description null until it is calculated */
            outcome: components["schemas"]["GuideOutcome"] | null;
        };
        /**
         * GuideStep
         * @description One look of a calibration.
         */
        GuideStep: {
            /** Cameras */
            cameras: components["schemas"]["GuideCamera"][];
            /**
             * Wanted
             * @description poses to take of each camera: what was asked for, or what is needed
             */
            wanted: number;
            /**
             * Fewest
             * @description poses of each camera without which nothing can be calculated
             */
            fewest: number;
            /**
             * Advice
             * @description what to do next
             * @enum {string}
             */
            advice: "taken" | "enough" | "unseen" | "one_axis" | "moving" | "unseen_by" | "ready" | "known";
            /**
             * Camera
             * @description which camera the advice is about; empty: all
             */
            camera: string;
            /**
             * Said
             * @description the advice in English
             */
            said: string;
            /**
             * Done
             * @description whether there are poses enough to calculate
             */
            done: boolean;
        };
        /**
         * GuideTake
         * @description How to look.
         */
        GuideTake: {
            /**
             * Take
             * @description keep the pose if the arm stands still and the board is seen
             * @default false
             */
            take: boolean;
        };
        /**
         * Health
         * @description The process is up. `boot_id` changes when the server restarts.
         */
        Health: {
            /**
             * Status
             * @default ok
             * @constant
             */
            status: "ok";
            /** Boot Id */
            boot_id: string;
        };
        /**
         * HistoryEntry
         * @description A closed proposal with what was said of it and what came of it.
         */
        HistoryEntry: {
            proposal: components["schemas"]["Proposal"];
            /**
             * Feedback
             * @description every click, oldest first: late and undone ones too
             */
            feedback: components["schemas"]["Feedback"][];
            execution: components["schemas"]["Execution"] | null;
        };
        /**
         * HistoryPage
         * @description Closed proposals, newest first unless asked for otherwise.
         */
        HistoryPage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["HistoryEntry"][];
        };
        /**
         * Incident
         * @description A safety violation or an emergency stop, with what the cameras saw in the seconds before.
         */
        Incident: {
            /** Id */
            id: number;
            /** Experiment Id */
            experiment_id: number;
            /** Execution Id */
            execution_id: number | null;
            /**
             * Kind
             * @enum {string}
             */
            kind: "damage" | "manual_reset" | "halt";
            /** Detail */
            detail: string;
            /**
             * At
             * Format: date-time
             */
            at: string;
            /**
             * Frames
             * @description oldest first; none where nothing had moved
             */
            frames: components["schemas"]["IncidentFrame"][];
        };
        /**
         * IncidentFrame
         * @description One picture of an incident's video.
         */
        IncidentFrame: {
            /** Camera */
            camera: string;
            /** Robot */
            robot: number;
            /** Width */
            width: number;
            /** Height */
            height: number;
            /**
             * Taken At
             * @description seconds since the epoch
             */
            taken_at: number;
            /**
             * Image
             * @description SHA-256 of the JPEG
             */
            image: string;
            /**
             * Url
             * @description path of the JPEG below the server's root
             */
            url: string;
        };
        /**
         * IncidentKept
         * @description A safety violation or an emergency stop was written down with its video: see `GET incidents/{id}`.
         */
        IncidentKept: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "incident_kept";
            /** Incident Id */
            incident_id: number;
            /**
             * Kind
             * @enum {string}
             */
            kind: "damage" | "manual_reset" | "halt";
        };
        /**
         * IncidentPage
         * @description Incidents, newest first.
         */
        IncidentPage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Incident"][];
        };
        /**
         * Invitation
         * @description An invitation as it stands; its token was told once.
         */
        Invitation: {
            /** Id */
            id: number;
            role: components["schemas"]["Role"];
            /** Experiment Id */
            experiment_id: number | null;
            /** Note */
            note: string;
            /** Uses */
            uses: number;
            /** Used */
            used: number;
            /**
             * Expires At
             * Format: date-time
             */
            expires_at: string;
            /** Access Until */
            access_until: string | null;
            /** Invited By */
            invited_by: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Revoked At */
            revoked_at: string | null;
        };
        /**
         * InvitationCreate
         * @description A link to hand out.
         */
        InvitationCreate: {
            /** @default trainer */
            role: components["schemas"]["Role"];
            /**
             * Experiment Id
             * @description the only experiment they may see; null: all
             */
            experiment_id: number | null;
            /**
             * Uses
             * @description how many people may use the link
             * @default 1
             */
            uses: number;
            /**
             * Hours
             * @description until the link ends
             * @default 24
             */
            hours: number;
            /**
             * Access Hours
             * @description until those who used it are let out; null: never
             */
            access_hours: number | null;
            /**
             * Note
             * @description for whom or what, in your own words
             * @default
             */
            note: string;
        };
        /**
         * InvitationMade
         * @description A new invitation, with what only its maker is told.
         */
        InvitationMade: {
            /** Id */
            id: number;
            role: components["schemas"]["Role"];
            /** Experiment Id */
            experiment_id: number | null;
            /** Note */
            note: string;
            /** Uses */
            uses: number;
            /** Used */
            used: number;
            /**
             * Expires At
             * Format: date-time
             */
            expires_at: string;
            /** Access Until */
            access_until: string | null;
            /** Invited By */
            invited_by: string;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Revoked At */
            revoked_at: string | null;
            /** Token */
            token: string;
            /**
             * Path
             * @description of the link, to be put behind the address of the service
             */
            path: string;
        };
        /**
         * InvitationPage
         * @description Invitations, newest first.
         */
        InvitationPage: {
            /** Items */
            items: components["schemas"]["Invitation"][];
            /** Next Cursor */
            next_cursor: string | null;
        };
        /**
         * Judge
         * @description A trainer who is there, and what they have before them.
         */
        Judge: {
            /** Trainer */
            trainer: string;
            /**
             * Proposal Id
             * @description the proposal that is theirs to judge
             */
            proposal_id: number | null;
            /**
             * Until
             * @description when it goes back, without a sign that they look at it
             */
            until: string | null;
            /**
             * Finishing
             * @description another proposal was approved while they looked at this one: what they say of it until then trains, and decides nothing
             * @default false
             */
            finishing: boolean;
            /**
             * Here
             * @description whether a page of theirs is connected
             * @default true
             */
            here: boolean;
            /**
             * Away
             * @description connected, but without a sign of life for longer than a lease: not asked, and not waited for, until the next one
             * @default false
             */
            away: boolean;
        };
        /**
         * JudgesChanged
         * @description Who is there to judge, and which open proposal each has before them.
         */
        JudgesChanged: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "judges_changed";
            /** Judges */
            judges: components["schemas"]["Judge"][];
        };
        /**
         * LabelQuality
         * @description Everybody's figures, and how far they agree.
         */
        LabelQuality: {
            /** Experiment Id */
            experiment_id: number;
            agreement: components["schemas"]["AgreementInfo"];
            /**
             * Gold
             * @description closed proposals whose answer was known
             */
            gold: number;
            /** Trainers */
            trainers: components["schemas"]["TrainerFigures"][];
        };
        /**
         * Lifecycle
         * @description Where an experiment is (DESIGN.md section 6). `halted` is a separate, latched flag.
         * @enum {string}
         */
        Lifecycle: "created" | "running" | "paused" | "finished" | "failed" | "archived";
        /**
         * Looked
         * @description What a trainer saw when they clicked. Where it isn't what the proposal shows, the click decides nothing.
         */
        Looked: {
            /** Observation Id */
            observation_id: string;
            /** Policy Version */
            policy_version: number;
        };
        /**
         * Me
         * @description Who asks.
         */
        Me: {
            /**
             * Login
             * @description whether anybody has to sign in here
             */
            login: boolean;
            /** Name */
            name: string | null;
            role: components["schemas"]["Role"] | null;
            /**
             * Experiment Id
             * @description the one experiment you were invited to
             */
            experiment_id: number | null;
            /** Access Until */
            access_until: string | null;
        };
        /**
         * MetricPage
         * @description Metric points, oldest first.
         */
        MetricPage: {
            /** Next Cursor */
            next_cursor: string | null;
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
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
         * NearbyLabel
         * @description A label of the same skill. alike: it was given in a situation like this one, no entry 2 cm away.
         */
        NearbyLabel: {
            /** Proposal Id */
            proposal_id: number;
            /** Number */
            number: number;
            /** X */
            x: number;
            /** Y */
            y: number;
            /**
             * Value
             * @enum {integer}
             */
            value: -1 | 0 | 1;
            /** Predicted Feedback */
            predicted_feedback: number;
            /** Alike */
            alike: boolean;
        };
        /**
         * Next
         * @description What a trainer is to judge, of all robots and slots; theirs until `judge.until`.
         */
        Next: {
            /** @description null: nothing waits for them now; ask again */
            proposal: components["schemas"]["Proposal"] | null;
            judge: components["schemas"]["Judge"];
        };
        /**
         * NextCreate
         * @description Ask for the next proposal.
         */
        NextCreate: {
            /**
             * Trainer
             * @default local
             */
            trainer: string;
        };
        /**
         * NoFields
         * @description The body of a verb that takes none: a field that is meant to do something is refused, not ignored.
         */
        NoFields: Record<string, never>;
        /**
         * Overlay
         * @description A proposal drawn for one camera, in pixels of the full-size image (see `robot_adapters.base.CameraOverlay`).
         */
        Overlay: {
            /** Dot */
            dot: [
                number,
                number
            ] | null;
            /** Line */
            line: [
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
            bar: [
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
            ring: [
                number,
                number
            ] | null;
            /**
             * In View
             * @default true
             */
            in_view: boolean;
            /**
             * Ghost
             * @description outlines of fingers and hand at the target; empty where not known
             * @default []
             */
            ghost: [
                number,
                number
            ][][];
            /**
             * Yaw
             * @description the gripper's angle, rad, that bar and ghost are drawn for
             */
            yaw: number | null;
            /**
             * Workspace
             * @description corners of where skills may act, the lower four first; empty where not known
             * @default []
             */
            workspace: [
                number,
                number
            ][];
        };
        /**
         * PaperCurve
         * @description One line of the paper; trial: which of single runs, null where it is the mean of all.
         */
        PaperCurve: {
            /** Algorithm */
            algorithm: string;
            /** Title */
            title: string;
            /** Trial */
            trial: number | null;
            /** X */
            x: number[];
            /** Y */
            y: number[];
        };
        /**
         * PaperFigure
         * @description What one of the paper's figures shows of a task, read off by eye; note: what it was measured on.
         */
        PaperFigure: {
            /** Scenario */
            scenario: string;
            /** Title */
            title: string;
            /** Task */
            task: string;
            /**
             * Axis
             * @enum {string}
             */
            axis: "feedback" | "low_level_steps" | "proposals" | "decisions";
            /**
             * Measure
             * @enum {string}
             */
            measure: "success_rate" | "successes";
            /** Note */
            note: string;
            /** Curves */
            curves: components["schemas"]["PaperCurve"][];
            /**
             * Violation Ratios
             * @description of the paper's safety table, by algorithm
             */
            violation_ratios: {
                [key: string]: number;
            };
        };
        /**
         * PaperFigures
         * @description The paper's results as numbers. source: where they are from, and how exact they are.
         */
        PaperFigures: {
            /** Source */
            source: string;
            /** Figures */
            figures: components["schemas"]["PaperFigure"][];
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
         * Person
         * @description Somebody who was let in.
         */
        Person: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            role: components["schemas"]["Role"];
            /** Experiment Id */
            experiment_id: number | null;
            /** Access Until */
            access_until: string | null;
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
            /** Revoked At */
            revoked_at: string | null;
            /**
             * Online
             * @description ids of the experiments that they look at now
             * @default []
             */
            online: number[];
        };
        /**
         * PersonPage
         * @description People, newest first.
         */
        PersonPage: {
            /** Items */
            items: components["schemas"]["Person"][];
            /** Next Cursor */
            next_cursor: string | null;
        };
        /**
         * PersonUpdate
         * @description What may change about somebody.
         */
        PersonUpdate: {
            role: components["schemas"]["Role"];
        };
        /**
         * Phase
         * @description What a running experiment is doing right now.
         * @enum {string}
         */
        Phase: "idle" | "starting" | "observing" | "proposing" | "awaiting_feedback" | "deciding" | "executing" | "learning" | "evaluating";
        /**
         * Pong
         * @description Answer to a ping; without one: say something, nothing was heard of you for a while.
         */
        Pong: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "pong";
        };
        /**
         * PracticeAnswer
         * @description What the trainer says of it.
         */
        PracticeAnswer: {
            /**
             * Click Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            click_id: string;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * Trainer
             * @default local
             */
            trainer: string;
        };
        /**
         * PracticeCard
         * @description A practice proposal that waits for its answer.
         */
        PracticeCard: {
            /** Id */
            id: number;
            /** Experiment Id */
            experiment_id: number;
            /**
             * Number
             * @description number among this trainer's, from 1
             */
            number: number;
            /** Task */
            task: string;
            /** Instruction */
            instruction: string;
            /** Skill */
            skill: string;
            /** Parameters */
            parameters: {
                [key: string]: number;
            };
            /**
             * Subgoal
             * @description what comes next, in words
             */
            subgoal: string;
            /** Views */
            views: components["schemas"]["View"][];
            /**
             * Opened At
             * Format: date-time
             */
            opened_at: string;
            progress: components["schemas"]["PracticeProgress"];
        };
        /**
         * PracticeCreate
         * @description Ask for the next practice proposal.
         */
        PracticeCreate: {
            /**
             * Trainer
             * @default local
             */
            trainer: string;
        };
        /**
         * PracticeProgress
         * @description How a trainer does in an experiment's practice.
         */
        PracticeProgress: {
            /** @description null: clicks count without any practice */
            required: components["schemas"]["PracticeRequired"] | null;
            /** Answered */
            answered: number;
            /** Right */
            right: number;
            /** @description right among the newest that are looked at */
            newest: components["schemas"]["Share"];
            /** Passed */
            passed: boolean;
            /**
             * Counts
             * @description whether this trainer's clicks count in the experiment now
             */
            counts: boolean;
        };
        /**
         * PracticeReason
         * @description Why the answer is what it is, from the task's own rule.
         */
        PracticeReason: {
            /** Good */
            good: boolean;
            /** Skill */
            skill: string;
            /** Right Skill */
            right_skill: string;
            /** Aim */
            aim: string;
            /** Sideways */
            sideways: boolean;
            /**
             * Slips
             * @description what is wrong about the place; of a good call nothing
             */
            slips: components["schemas"]["PracticeSlip"][];
            /** @description of a good call: the coordinate that is furthest out */
            closest: components["schemas"]["PracticeSlip"] | null;
            /**
             * Text
             * @description all of it in words
             */
            text: string;
        };
        /**
         * PracticeRequired
         * @description What a new trainer has to show in practice before their clicks count.
         */
        PracticeRequired: {
            /**
             * Proposals
             * @description newest practice proposals that are looked at
             * @default 10
             */
            proposals: number;
            /**
             * Accuracy
             * @description share of them that must be judged right
             * @default 0.8
             */
            accuracy: number;
        };
        /**
         * PracticeResult
         * @description The instant correction.
         */
        PracticeResult: {
            /** Id */
            id: number;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * Right Answer
             * @enum {integer}
             */
            right_answer: -1 | 1;
            /** Right */
            right: boolean;
            reason: components["schemas"]["PracticeReason"];
            /**
             * Right Overlays
             * @description a call that would be good, drawn for each camera
             */
            right_overlays: {
                [key: string]: components["schemas"]["Overlay"];
            };
            progress: components["schemas"]["PracticeProgress"];
        };
        /**
         * PracticeSlip
         * @description How far the call is from the ideal along an axis of the robot's base frame, and how far counts as good.
         */
        PracticeSlip: {
            /**
             * Axis
             * @description x: away from the robot; y: to its left; z: up; end: of a push; place: in any direction
             * @enum {string}
             */
            axis: "x" | "y" | "z" | "end" | "place";
            /** Off Mm */
            off_mm: number;
            /** Limit Mm */
            limit_mm: number;
        };
        /**
         * Present
         * @description Somebody who is on-line in an experiment.
         */
        Present: {
            /** Name */
            name: string;
            role: components["schemas"]["Role"];
            /**
             * Since
             * Format: date-time
             */
            since: string;
            /**
             * Streams
             * @description open pages; two of one person are one person
             */
            streams: number;
        };
        /**
         * PresentList
         * @description Everyone who is on-line in an experiment, who came first first.
         */
        PresentList: {
            /** Items */
            items: components["schemas"]["Present"][];
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
             * Robot
             * @description which robot of the experiment, from 0
             */
            robot: number;
            /**
             * Slot
             * @description which of the robot's open proposals at once, from 0
             * @default 0
             */
            slot: number;
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
            /**
             * Uncertainty
             * @description how far the critics disagree, a standard deviation of predicted feedback; null: not known
             */
            uncertainty: number | null;
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
            subgoal: string | null;
            /** Views */
            views: components["schemas"]["View"][];
            /**
             * Opened At
             * Format: date-time
             */
            opened_at: string;
            /** Closed At */
            closed_at: string | null;
            close_reason: components["schemas"]["CloseReason"] | null;
            verdict: components["schemas"]["Verdict"] | null;
            verdict_source: components["schemas"]["VerdictSource"] | null;
            /** @description by which the trainers' verdict was reached */
            rule: components["schemas"]["Aggregation"] | null;
            /**
             * Superseded By
             * @description the proposal that was approved first
             */
            superseded_by: number | null;
            /**
             * Electorate
             * @description whose votes are asked for
             * @default []
             */
            electorate: string[];
            /**
             * Heard
             * @description who has voted, in order; what, is told once it is closed
             * @default []
             */
            heard: string[];
            /**
             * Audit
             * @description the critic would have approved it; a trainer was asked to check the critic
             * @default false
             */
            audit: boolean;
            gate: components["schemas"]["GateDecision"] | null;
            /**
             * Purpose
             * @default training
             * @enum {string}
             */
            purpose: "training" | "evaluation";
        };
        /**
         * ProposalChanged
         * @description Somebody has voted on an open proposal, or its electorate is another; what was said is told once it is closed.
         */
        ProposalChanged: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "proposal_changed";
            proposal: components["schemas"]["Proposal"];
        };
        /**
         * ProposalClosed
         * @description A proposal is closed; `proposal.verdict`, `.close_reason` and `.gate` say how.
         */
        ProposalClosed: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Proposal"][];
        };
        /**
         * Readiness
         * @description Whether work can be done; each check is `ok` or says what is wrong.
         */
        Readiness: {
            /** Ready */
            ready: boolean;
            /** Checks */
            checks: {
                [key: string]: string;
            };
        };
        /**
         * Refused
         * @description Answer to a client's message that could not be taken; nothing changed.
         */
        Refused: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
         * Relabel
         * @description One correction. The click itself stays as it was given.
         */
        Relabel: {
            /** Id */
            id: number;
            /** Click Id */
            click_id: string;
            /**
             * Trainer
             * @description who corrected it
             */
            trainer: string;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * At
             * Format: date-time
             */
            at: string;
        };
        /**
         * RelabelCreate
         * @description Correct a click on a proposal that is closed.
         */
        RelabelCreate: {
            /**
             * Click Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            click_id: string;
            /**
             * Value
             * @description -1 bad, 0 neutral, +1 good; cant_tell: nothing can be said from this view. That is an abstention: stored, never learned from, and neither for nor against
             * @enum {unknown}
             */
            value: -1 | 0 | 1 | "cant_tell";
            /**
             * Trainer
             * @default local
             */
            trainer: string;
        };
        /**
         * Report
         * @description One report. The execution's own outcome stays as the robot told it.
         */
        Report: {
            /** Report Id */
            report_id: string;
            /**
             * Outcome
             * @description what a person saw; needs_reset: the task can't go on without a hand
             * @enum {string}
             */
            outcome: "success" | "failed" | "damage" | "needs_reset";
            /** Note */
            note: string;
            /** Trainer */
            trainer: string;
            /**
             * At
             * Format: date-time
             */
            at: string;
        };
        /**
         * ReportCreate
         * @description What somebody saw an execution do, where the robot can't tell by itself.
         */
        ReportCreate: {
            /**
             * Report Id
             * @description made by the client, unique per click; the same id again is acknowledged again and stored once
             */
            report_id: string;
            /**
             * Outcome
             * @description what a person saw; needs_reset: the task can't go on without a hand
             * @enum {string}
             */
            outcome: "success" | "failed" | "damage" | "needs_reset";
            /**
             * Note
             * @default
             */
            note: string;
            /**
             * Trainer
             * @default local
             */
            trainer: string;
        };
        /**
         * Resumed
         * @description The first message of a connection that goes on where one ended: the missed events follow, none is missing.
         */
        Resumed: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "resumed";
            /**
             * Missed
             * @description how many events follow that happened in between
             */
            missed: number;
        };
        /**
         * RobotTold
         * @description What a robot told of itself when it was looked at, or stood still again; while it moves, frames carry it.
         */
        RobotTold: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "robot_told";
            /**
             * Robot
             * @description which robot of the experiment, from 0
             */
            robot: number;
            telemetry: components["schemas"]["Telemetry"];
        };
        /**
         * Role
         * @description What someone may do; each may also do what those before it may.
         * @enum {string}
         */
        Role: "viewer" | "trainer" | "operator" | "owner";
        /**
         * SceneInfo
         * @description A task's scene, enough to draw it from the state alone. Lengths in m, robot base frame.
         */
        SceneInfo: {
            /** Table Height */
            table_height: number;
            /** Table Centre */
            table_centre: [
                number,
                number
            ];
            /**
             * Workspace
             * @description corners of where skills may act
             */
            workspace: [
                [
                    number,
                    number,
                    number
                ],
                [
                    number,
                    number,
                    number
                ]
            ] | null;
            /** Objects */
            objects: components["schemas"]["SceneObject"][];
            /**
             * Gripper At
             * @description index in the state of the grip site's x; null: not told
             */
            gripper_at: number | null;
        };
        /**
         * SceneObject
         * @description Something on the table, and where the state vector tells its place. All lengths in m, robot base frame.
         */
        SceneObject: {
            /** Name */
            name: string;
            /** Parts */
            parts: components["schemas"]["Solid"][];
            /**
             * Fixed
             * @description where it stands, or stands when slid shut
             */
            fixed: [
                number,
                number,
                number
            ] | null;
            /**
             * State At
             * @description index of its x in the state, y and maybe z after it; null: not told
             */
            state_at: number | null;
            /**
             * State Size
             * @description 2: the state has no z, it lies on the table
             * @default 3
             */
            state_size: number;
            /**
             * Slides At
             * @description index in the state of how far it is from `fixed` towards the robot
             */
            slides_at: number | null;
            /**
             * Rests
             * @description height of its origin above the table when it lies there
             * @default 0
             */
            rests: number;
        };
        /**
         * Share
         * @description So many of so many.
         */
        Share: {
            /** Count */
            count: number;
            /** Of */
            of: number;
        };
        /**
         * SignIn
         * @description What lets somebody in. An invitation asks for a name; one's own token doesn't.
         */
        SignIn: {
            /**
             * Token
             * @description of an invitation, or one's own
             */
            token: string;
            /**
             * Name
             * @description under which you judge; with an invitation only
             */
            name: string | null;
            /**
             * Bearer
             * @description true: for a program, the answer has a token for `Authorization: Bearer`; no cookie
             * @default false
             */
            bearer: boolean;
        };
        /**
         * SignedIn
         * @description Who is signed in now.
         */
        SignedIn: {
            /**
             * Login
             * @description whether anybody has to sign in here
             */
            login: boolean;
            /** Name */
            name: string | null;
            role: components["schemas"]["Role"] | null;
            /**
             * Experiment Id
             * @description the one experiment you were invited to
             */
            experiment_id: number | null;
            /** Access Until */
            access_until: string | null;
            /**
             * Token
             * @description shown this once; only where it was asked for
             */
            token: string | null;
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
         * @description Everything a page needs to draw itself: the first message of a connection that doesn't go on where one ended.
         *
         *     Its `seq` is that of the last event before it.
         */
        Snapshot: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "snapshot";
            experiment: components["schemas"]["Experiment"];
            /** @description the oldest open proposal, if any */
            proposal: components["schemas"]["Proposal"] | null;
            /**
             * Proposals
             * @description every open proposal, one a slot of a robot, oldest first
             */
            proposals: components["schemas"]["Proposal"][];
            /** @description what this trainer may still judge although it is closed: `Judge.finishing` */
            finishing: components["schemas"]["Proposal"] | null;
            /**
             * Judges
             * @description who is there to judge, and at what
             * @default []
             */
            judges: components["schemas"]["Judge"][];
            /** @description the oldest running execution, if any */
            execution: components["schemas"]["Execution"] | null;
            /**
             * Executions
             * @description every running execution, oldest first
             */
            executions: components["schemas"]["Execution"][];
            /** @description this trainer's newest feedback, while it can be undone */
            undoable: components["schemas"]["Feedback"] | null;
            /**
             * Robots
             * @description what each robot told of itself last
             * @default []
             */
            robots: components["schemas"]["RobotTold"][];
            /**
             * Operator
             * @description who attends the real robot; null: nobody does
             */
            operator: string | null;
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
         * Solid
         * @description A visible part of an object: a box, or a disc or ring about z. `centre` from the object's origin, m.
         */
        Solid: {
            /**
             * Shape
             * @enum {string}
             */
            shape: "box" | "disc" | "ring" | "sphere";
            /** Centre */
            centre: [
                number,
                number,
                number
            ];
            /** Half */
            half: [
                number,
                number,
                number
            ];
            /** Colour */
            colour: [
                number,
                number,
                number
            ];
            /**
             * Opacity
             * @default 1
             */
            opacity: number;
        };
        /**
         * StoredEvent
         * @description One line of the experiment's journal.
         */
        StoredEvent: {
            /** Id */
            id: number;
            /** Kind */
            kind: string;
            /** Payload */
            payload: {
                [key: string]: unknown;
            };
            /**
             * At
             * Format: date-time
             */
            at: string;
        };
        /**
         * Stretch
         * @description What was said of closed proposals within one stretch of time, as it counts by now, and what came of it.
         */
        Stretch: {
            /**
             * At
             * Format: date-time
             * @description when it begins
             */
            at: string;
            /** Good */
            good: number;
            /** Neutral */
            neutral: number;
            /** Bad */
            bad: number;
            /** Cant Tell */
            cant_tell: number;
            /**
             * Executions
             * @description motions that began in it, or before the next one that is told
             */
            executions: number;
            /**
             * Violations
             * @description those of them with a safety violation
             */
            violations: number;
            /**
             * Proposal
             * @description number of the first one that was judged in it
             */
            proposal: number;
            /**
             * Episode
             * @description number of that proposal's episode
             */
            episode: number;
        };
        /**
         * Study
         * @description A study with its runs and curves so far. files: what `files/{file}` has, once the study has come to its end.
         */
        Study: {
            /** Name */
            name: string;
            /** Study */
            study: string | null;
            /** Adapter */
            adapter: string | null;
            /** Created At */
            created_at: string | null;
            /** Live */
            live: boolean;
            /** Done */
            done: number;
            /** Runs */
            runs: number;
            /** Finished */
            finished: number;
            /** Failed */
            failed: number;
            /** Problem */
            problem: string | null;
            /** Versions */
            versions: {
                [key: string]: string;
            };
            /** Scenarios */
            scenarios: components["schemas"]["StudyScenario"][];
            /** Run List */
            run_list: components["schemas"]["StudyRun"][];
            /** Files */
            files: string[];
        };
        /**
         * StudyCurve
         * @description The mean at common points of the seeds that are about as far as each other; sem: its standard error.
         *
         *     seeds: how many they are, of those `planned`; sem is null from one seed.
         */
        StudyCurve: {
            /** Algorithm */
            algorithm: string;
            /** Title */
            title: string;
            /** Seeds */
            seeds: number;
            /** Planned */
            planned: number;
            /** X */
            x: number[];
            /** Mean */
            mean: number[];
            /** Sem */
            sem: (number | null)[];
        };
        /**
         * StudyPaperCurve
         * @description What the paper's figure shows; trial: which of single runs, null where it is the mean of all.
         */
        StudyPaperCurve: {
            /** Algorithm */
            algorithm: string;
            /** Title */
            title: string;
            /** Trial */
            trial: number | null;
            /** X */
            x: number[];
            /** Y */
            y: number[];
        };
        /**
         * StudyRun
         * @description One contestant in one scenario from one seed. rate: units of the scenario's axis a second.
         */
        StudyRun: {
            /** Id */
            id: string;
            /** Scenario */
            scenario: string;
            /** Algorithm */
            algorithm: string;
            /** Title */
            title: string;
            /** Seed */
            seed: number;
            /** Budget */
            budget: number;
            /**
             * State
             * @enum {string}
             */
            state: "waiting" | "running" | "interrupted" | "finished" | "failed";
            /** Done */
            done: number;
            /** Decisions */
            decisions: number;
            /** Low Level Steps */
            low_level_steps: number;
            /** Successes */
            successes: number;
            /** Violations */
            violations: number;
            /** Evaluations */
            evaluations: number;
            /** Success Rate */
            success_rate: number | null;
            /** Rate */
            rate: number | null;
            /** Seconds */
            seconds: number;
            /** Error */
            error: string | null;
        };
        /**
         * StudyScenario
         * @description A task as one figure looks at it: our curves, the paper's, and a caption for means and standard errors.
         */
        StudyScenario: {
            /** Name */
            name: string;
            /** Title */
            title: string;
            /**
             * Axis
             * @enum {string}
             */
            axis: "low_level_steps" | "decisions";
            /**
             * Measure
             * @enum {string}
             */
            measure: "success_rate" | "successes";
            /** Caption */
            caption: string;
            /** Curves */
            curves: components["schemas"]["StudyCurve"][];
            /** Paper */
            paper: components["schemas"]["StudyPaperCurve"][];
        };
        /**
         * StudySummary
         * @description A study in the list. live: a process works on it now. done: 0 to 1. problem: why it can't be read.
         */
        StudySummary: {
            /** Name */
            name: string;
            /** Study */
            study: string | null;
            /** Adapter */
            adapter: string | null;
            /** Created At */
            created_at: string | null;
            /** Live */
            live: boolean;
            /** Done */
            done: number;
            /** Runs */
            runs: number;
            /** Finished */
            finished: number;
            /** Failed */
            failed: number;
            /** Problem */
            problem: string | null;
        };
        /**
         * TagInfo
         * @description A tag in use. experiments: how many carry it.
         */
        TagInfo: {
            /** Tag */
            tag: string;
            /** Experiments */
            experiments: number;
        };
        /**
         * TakenBack
         * @description A click that was taken back, without what it said: others may still be asked.
         */
        TakenBack: {
            /** Id */
            id: number;
            /** Click Id */
            click_id: string;
            /** Proposal Id */
            proposal_id: number;
            /** Trainer */
            trainer: string;
            /** Undone At */
            undone_at: string | null;
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
            /**
             * By Hand
             * @description what to do by hand where only that helps; empty: the task doesn't say
             */
            by_hand: string;
            scene: components["schemas"]["SceneInfo"];
        };
        /**
         * TeacherInfo
         * @description A synthetic trainer of the catalogue; `settings_schema` is JSON Schema.
         */
        TeacherInfo: {
            /** Name */
            name: string;
            /** Description */
            description: string;
            /** Settings Schema */
            settings_schema: {
                [key: string]: unknown;
            };
        };
        /**
         * Telemetry
         * @description What a robot tells of itself beside its state; what it can't tell is empty or null.
         */
        Telemetry: {
            /**
             * Joints
             * @description rad, base to wrist
             * @default []
             */
            joints: number[];
            /**
             * Joint Limits
             * @description lowest and highest of each joint, rad
             * @default []
             */
            joint_limits: [
                number,
                number
            ][];
            /**
             * Gripper
             * @description grip site, m, robot base frame
             */
            gripper: [
                number,
                number,
                number
            ] | null;
            /**
             * Opening
             * @description m between the fingers
             */
            opening: number | null;
            /**
             * Force
             * @description N at the hand, in its own frame
             */
            force: [
                number,
                number,
                number
            ] | null;
            /**
             * Calibration
             * @description of the cameras: computed, calibrated, or not to be trusted
             */
            calibration: ("exact" | "measured" | "missing") | null;
            /**
             * Calibration Detail
             * @description when and how well, in words
             * @default
             */
            calibration_detail: string;
            /**
             * Scene
             * @description whether it is as the newest picture shows it; null where nobody looks again
             */
            scene: ("clear" | "changed" | "unclear") | null;
            /**
             * Scene Detail
             * @description why it isn't, in words that a trainer understands
             * @default
             */
            scene_detail: string;
            /**
             * Mode
             * @description what a real arm is doing; null for a simulated one
             */
            mode: ("idle" | "moving" | "reflex" | "user_stopped" | "disconnected") | null;
            /**
             * Words
             * @description the same in words that a trainer understands
             * @default
             */
            words: string;
        };
        /**
         * Timeline
         * @description How an experiment's labels came in: stretches of the same length, oldest first, without those that have none.
         */
        Timeline: {
            /**
             * Seconds
             * @description length of each stretch
             */
            seconds: number;
            /**
             * Started At
             * @description of the first label, to the second; null: there is none
             */
            started_at: string | null;
            /**
             * Ended At
             * @description of the last label, to the second
             */
            ended_at: string | null;
            /** Stretches */
            stretches: components["schemas"]["Stretch"][];
        };
        /**
         * Together
         * @description How several trainers share the proposals of one experiment.
         */
        Together: {
            /**
             * Parallel
             * @description each trainer gets a proposal of their own; the first that is approved closes the others
             * @default false
             */
            parallel: boolean;
            /**
             * Weighted Approves
             * @description whether the rule `weighted` may approve by estimated reliability alone; else more than half of the heads have to say good as well
             * @default false
             */
            weighted_approves: boolean;
            /**
             * Least
             * @description how many trainers at least have to say good before a robot moves, however few are left
             * @default 1
             */
            least: number;
            /**
             * Lease Seconds
             * @description how long a proposal stays with the trainer it was given to, without a sign that they look at it; then they are away, and nobody waits for them
             * @default 60
             */
            lease_seconds: number;
            /**
             * Vanish Seconds
             * @description how long a trainer who is gone is waited for before the proposals that are open are decided without them
             * @default 10
             */
            vanish_seconds: number;
            /**
             * Finish Seconds
             * @description how long a trainer may still judge what they had before them when another proposal was approved: it trains, and decides nothing
             * @default 20
             */
            finish_seconds: number;
        };
        /**
         * TogetherUpdate
         * @description What may change of it live; a field left out stays.
         */
        TogetherUpdate: {
            /** Parallel */
            parallel: boolean | null;
            /** Weighted Approves */
            weighted_approves: boolean | null;
            /** Least */
            least: number | null;
            /** Lease Seconds */
            lease_seconds: number | null;
            /** Vanish Seconds */
            vanish_seconds: number | null;
            /** Finish Seconds */
            finish_seconds: number | null;
        };
        /**
         * TokenCreate
         * @description A token for a program of one's own.
         */
        TokenCreate: {
            /**
             * Note
             * @description for whom or what, in your own words
             * @default
             */
            note: string;
        };
        /**
         * TokenMade
         * @description A new token; it is told this once.
         */
        TokenMade: {
            /** Token */
            token: string;
        };
        /**
         * Trainer
         * @description Someone who judges: a person, or a teacher.
         */
        Trainer: {
            /** Id */
            id: number;
            /** Name */
            name: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "person" | "teacher" | "evaluation";
            /**
             * Created At
             * Format: date-time
             */
            created_at: string;
        };
        /**
         * TrainerFigures
         * @description One trainer's work in one experiment.
         */
        TrainerFigures: {
            /** Trainer */
            trainer: string;
            /**
             * Kind
             * @enum {string}
             */
            kind: "person" | "teacher";
            /**
             * Labels
             * @description good, neutral and bad clicks that counted
             */
            labels: number;
            /** Good */
            good: number;
            /** Neutral */
            neutral: number;
            /** Bad */
            bad: number;
            /** Cant Tell */
            cant_tell: number;
            /** Late */
            late: number;
            /**
             * Relabelled
             * @description clicks corrected later
             */
            relabelled: number;
            /**
             * Per Minute
             * @description clicks a minute at work; a pause of more than a minute isn't work
             */
            per_minute: number | null;
            /** @description labels that agree with the verdict, where others judged too */
            with_verdicts: components["schemas"]["Share"];
            /** @description labels that agree with another trainer's of the same proposal */
            with_others: components["schemas"]["Share"];
            /** @description known answers hit; told to the trainer after each fifty clicks, so that none is given away */
            gold: components["schemas"]["Share"];
            /**
             * Streak
             * @description newest labels in a row that neither a verdict of several nor a correction contradicts
             */
            streak: number;
            /** @description null in one's own figures: it gives known answers away */
            estimate: components["schemas"]["Estimate"] | null;
        };
        /**
         * TrainerPage
         * @description Trainers by id.
         */
        TrainerPage: {
            /** Next Cursor */
            next_cursor: string | null;
            /** Items */
            items: components["schemas"]["Trainer"][];
        };
        /**
         * Verdict
         * @description What the trainers' feedback on a proposal adds up to.
         * @enum {string}
         */
        Verdict: "good" | "neutral" | "bad";
        /**
         * VerdictSource
         * @description Who a verdict is by. `critic`: auto-approval in simulation; there is no feedback, and nothing learns from it.
         * @enum {string}
         */
        VerdictSource: "trainers" | "critic" | "evaluation";
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
         * Violation
         * @description A safety violation that the robot noticed.
         */
        Violation: {
            /**
             * Kind
             * @enum {string}
             */
            kind: "damage" | "manual_reset";
            /** Detail */
            detail: string;
        };
        /**
         * WorkerChanged
         * @description A worker process started, died or was restarted.
         */
        WorkerChanged: {
            /**
             * Seq
             * @description the event's number in the experiment's stream, from 1 since the service started (`boot_id`); null where only this connection hears it. Connect again with `?boot_id=...&since=<the last seq>` to hear what was missed
             */
            seq: number | null;
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
             * Robot
             * @description which robot, from 0; null for the learner
             */
            robot: number | null;
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
    list_tasks: {
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
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_task: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                name: string;
            };
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
                    "application/json": components["schemas"]["TaskInfo"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_adapters: {
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
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_adapter: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                name: string;
            };
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
                    "application/json": components["schemas"]["AdapterInfo"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_algorithms: {
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
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_algorithm: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                name: string;
            };
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
                    "application/json": components["schemas"]["AlgorithmInfo"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_teachers: {
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
                    "application/json": components["schemas"]["TeacherInfo"][];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_teacher: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                name: string;
            };
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
                    "application/json": components["schemas"]["TeacherInfo"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_experiments: {
        parameters: {
            query?: {
                /** @description of this one only */
                task?: string | null;
                /** @description of this one only */
                adapter?: string | null;
                /** @description of this one only */
                algorithm?: string | null;
                /** @description where it is */
                lifecycle?: components["schemas"]["Lifecycle"] | "halted" | null;
                /** @description carries every one of these */
                tag?: string[];
                /** @description part of the name or of a tag */
                text?: string | null;
                sort?: "created" | "updated" | "name" | "feedback" | "good_share" | "successes" | "violations";
                order?: "asc" | "desc";
                /** @description `next_cursor` of the page before */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
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
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    create_experiment: {
        parameters: {
            query?: never;
            header?: {
                /** @description made by the client, unique per intention; the same key with the same body gets the same answer for 24 hours, with another body 409 */
                "Idempotency-Key"?: string | null;
            };
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
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    update_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    start_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody?: {
            content: {
                "application/json": components["schemas"]["NoFields"] | null;
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
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    pause_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    resume_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody?: {
            content: {
                "application/json": components["schemas"]["NoFields"] | null;
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
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    finish_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    reset_episode: {
        parameters: {
            query?: {
                /** @description which robot, from 0; left out: every one */
                robot?: number | null;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    halt_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    rearm_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    archive_experiment: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    evaluate_experiment: {
        parameters: {
            query?: never;
            header?: {
                /** @description made by the client, unique per intention; the same key with the same body gets the same answer for 24 hours, with another body 409 */
                "Idempotency-Key"?: string | null;
            };
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["EvaluationCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            202: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Evaluation"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    attend: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Attending"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Attending"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    leave: {
        parameters: {
            query: {
                /** @description who attends the robot */
                operator: string;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    recover: {
        parameters: {
            query?: {
                /** @description who orders it, where nobody signs in */
                operator?: string | null;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    home: {
        parameters: {
            query?: {
                /** @description who orders it, where nobody signs in */
                operator?: string | null;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Experiment"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_camera_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["GuideState"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    store_camera_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["GuideOutcome"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    begin_camera_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["GuideBegin"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["GuideStep"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    look_for_the_board: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["GuideTake"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["GuideStep"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    solve_camera_calibration: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["GuideOutcome"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_proposals: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    next_proposal: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["NextCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Next"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_proposal: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: number;
            };
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
                    "application/json": components["schemas"]["Proposal"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_image: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: number;
                camera: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The JPEG */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "image/jpeg": string;
                };
            };
            /** @description The client has it already */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_feedback_of_proposal: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
                /** @description who asks, where nobody signs in: another's click is nobody's to take or to see */
                trainer?: string | null;
            };
            header?: never;
            path: {
                proposal_id: number;
            };
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
                    "application/json": components["schemas"]["FeedbackPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    give_feedback: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FeedbackCreate"];
            };
        };
        responses: {
            /** @description This very click is stored already */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_feedback: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
                /** @description only this trainer's; another's than one's own: operators only */
                trainer?: string | null;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["FeedbackPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_feedback: {
        parameters: {
            query?: {
                /** @description who asks, where nobody signs in: another's click is nobody's to take or to see */
                trainer?: string | null;
            };
            header?: never;
            path: {
                feedback_id: number;
            };
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
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    undo_feedback: {
        parameters: {
            query?: {
                /** @description who asks, where nobody signs in: another's click is nobody's to take or to see */
                trainer?: string | null;
            };
            header?: never;
            path: {
                feedback_id: number;
            };
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
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    relabel_feedback: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                feedback_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RelabelCreate"];
            };
        };
        responses: {
            /** @description This very correction is stored already */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Feedback"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_history: {
        parameters: {
            query?: {
                skill?: string | null;
                verdict?: ("good" | "neutral" | "bad" | "none") | null;
                /** @description somebody says so by now */
                label?: ("good" | "neutral" | "bad" | "cant_tell") | null;
                executed?: boolean | null;
                violation?: boolean | null;
                /** @description its number */
                episode?: number | null;
                purpose?: ("training" | "evaluation") | null;
                order?: "asc" | "desc";
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["HistoryPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_timeline: {
        parameters: {
            query?: {
                /** @description into at most how many the time is divided */
                stretches?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Timeline"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_episodes: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["EpisodePage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_episode: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
                /** @description the episode's number in its experiment */
                number: number;
            };
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
                    "application/json": components["schemas"]["Episode"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    report_execution: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                execution_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ReportCreate"];
            };
        };
        responses: {
            /** @description This very report is stored already */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Execution"];
                };
            };
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Execution"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_execution: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                execution_id: number;
            };
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
                    "application/json": components["schemas"]["Execution"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_incidents: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["IncidentPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_incident: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                incident_id: number;
            };
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
                    "application/json": components["schemas"]["Incident"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_incident_frame: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                incident_id: number;
                index: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The picture */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "image/jpeg": unknown;
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_me: {
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
                    "application/json": components["schemas"]["Me"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sign_in: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["SignIn"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["SignedIn"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    sign_out: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    make_token: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["TokenCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["TokenMade"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_invitations: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
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
                    "application/json": components["schemas"]["InvitationPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    invite: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["InvitationCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            201: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["InvitationMade"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    revoke_invitation: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                invitation_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_people: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
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
                    "application/json": components["schemas"]["PersonPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    revoke_person: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                person_id: number;
            };
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
                    "application/json": components["schemas"]["Person"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    update_person: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                person_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PersonUpdate"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["Person"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_present: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["PresentList"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_audit: {
        parameters: {
            query?: {
                /** @description only of this experiment */
                experiment?: number | null;
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
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
                    "application/json": components["schemas"]["AuditPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_audit: {
        parameters: {
            query?: {
                /** @description only of this experiment */
                experiment?: number | null;
            };
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv": unknown;
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_executions: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["ExecutionPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_metrics: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_events: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["EventPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_evaluations: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_checkpoints: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["CheckpointPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_trainers: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
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
                    "application/json": components["schemas"]["TrainerPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_curves: {
        parameters: {
            query?: {
                /** @description about the most points of a curve */
                points?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Curves"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_metrics: {
        parameters: {
            query?: {
                /** @description csv, or jsonl: one JSON object a line */
                format?: "csv" | "jsonl";
            };
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv; charset=utf-8": unknown;
                    "application/x-ndjson": unknown;
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    compare_experiments: {
        parameters: {
            query: {
                /** @description which, again for each one */
                experiment: number[];
                measure?: "successes" | "success_rate" | "violation_ratio" | "good_share" | "critic_loss" | "estimate_error";
                /** @description experiments that agree in all of these are one curve; none: one each */
                by?: ("task" | "algorithm" | "preset" | "adapter" | "teacher" | "tag")[];
            };
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
                    "application/json": components["schemas"]["Comparison"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_paper_figures: {
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
                    "application/json": components["schemas"]["PaperFigures"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_tags: {
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
                    "application/json": components["schemas"]["TagInfo"][];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_calibration: {
        parameters: {
            query?: {
                /** @description newest judged proposals that count: the critic changes */
                newest?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["Calibration"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_auto_approval: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["AutoApprovalRecord"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_critic_map: {
        parameters: {
            query?: {
                /** @description left out: the proposal's own */
                skill?: string | null;
                /** @description of the map's longer side */
                points?: number;
                /** @description a parameter beside x and y, the same everywhere */
                other?: string[];
            };
            header?: never;
            path: {
                proposal_id: number;
            };
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
                    "application/json": components["schemas"]["CriticMap"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_considered: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: number;
            };
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
                    "application/json": components["schemas"]["ConsideredList"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_quality: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["LabelQuality"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_own_figures: {
        parameters: {
            query?: {
                /** @description whose, for operators; left out: one's own */
                trainer?: string | null;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["TrainerFigures"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_gold: {
        parameters: {
            query?: {
                /** @description `next_cursor` of the page before; none: first page */
                cursor?: string | null;
                /** @description most items of a page */
                limit?: number;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["GoldPage"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    mark_gold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["GoldMark"];
            };
        };
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    unmark_gold: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                proposal_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description Successful Response */
            204: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    export_feedback: {
        parameters: {
            query?: {
                /** @description csv, or jsonl: one JSON object a line */
                format?: "csv" | "jsonl";
            };
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The table */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "text/csv; charset=utf-8": unknown;
                    "application/x-ndjson": unknown;
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_practice: {
        parameters: {
            query?: {
                /** @description whose, for operators; left out: one's own */
                trainer?: string | null;
            };
            header?: never;
            path: {
                experiment_id: number;
            };
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
                    "application/json": components["schemas"]["PracticeProgress"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    next_practice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                experiment_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PracticeCreate"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PracticeCard"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    answer_practice: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                practice_id: number;
            };
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["PracticeAnswer"];
            };
        };
        responses: {
            /** @description Successful Response */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/json": components["schemas"]["PracticeResult"];
                };
            };
            /** @description The body is no JSON, or nested too deeply */
            400: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The state of things doesn't allow it; `current` and `allowed` say what does */
            409: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The body is too large */
            413: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_practice_image: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                practice_id: number;
                camera: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The JPEG */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "image/jpeg": string;
                };
            };
            /** @description The client has it already */
            304: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    list_studies: {
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
                    "application/json": components["schemas"]["StudySummary"][];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_study: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description name of the study's folder */
                name: string;
            };
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
                    "application/json": components["schemas"]["Study"];
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description A field is wrong; `fields` names it */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    get_study_file: {
        parameters: {
            query?: never;
            header?: never;
            path: {
                /** @description name of the study's folder */
                name: string;
                file: string;
            };
            cookie?: never;
        };
        requestBody?: never;
        responses: {
            /** @description The file */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/octet-stream": unknown;
                };
            };
            /** @description Nobody is signed in */
            401: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description The role doesn't allow it; or a foreign page, or a foreign host name */
            403: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Nothing has this id or name */
            404: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Validation Error */
            422: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Too many requests; `Retry-After` says when to come again */
            429: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description An error of the service's own */
            500: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
            /** @description Storage or a worker can't be had right now */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    health: {
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
                    "application/json": components["schemas"]["Health"];
                };
            };
        };
    };
    ready: {
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
                    "application/json": unknown;
                };
            };
            /** @description Not ready */
            503: {
                headers: {
                    [name: string]: unknown;
                };
                content: {
                    "application/problem+json": components["schemas"]["Problem"];
                };
            };
        };
    };
    stream_eventstream_event_post: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Snapshot"] | components["schemas"]["Resumed"] | components["schemas"]["ExperimentChanged"] | components["schemas"]["ProposalOpened"] | components["schemas"]["ProposalChanged"] | components["schemas"]["ProposalClosed"] | components["schemas"]["JudgesChanged"] | components["schemas"]["FeedbackStored"] | components["schemas"]["FeedbackUndone"] | components["schemas"]["FeedbackRelabelled"] | components["schemas"]["ExecutionStarted"] | components["schemas"]["ExecutionEnded"] | components["schemas"]["MetricsAdded"] | components["schemas"]["WorkerChanged"] | components["schemas"]["RobotTold"] | components["schemas"]["AttendanceChanged"] | components["schemas"]["IncidentKept"] | components["schemas"]["EvaluationChanged"] | components["schemas"]["Acknowledged"] | components["schemas"]["Refused"] | components["schemas"]["Pong"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    stream_framestream_frame_post: {
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
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    stream_messagestream_message_post: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ClientFeedback"] | components["schemas"]["ClientLook"] | components["schemas"]["ClientRelabel"] | components["schemas"]["ClientUndo"] | components["schemas"]["ClientHalt"] | components["schemas"]["ClientFrameAck"] | components["schemas"]["ClientPing"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_snapshot: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Snapshot"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_resumed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Resumed"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_experiment_changed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ExperimentChanged"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_proposal_opened: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ProposalOpened"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_proposal_changed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ProposalChanged"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_proposal_closed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ProposalClosed"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_judges_changed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["JudgesChanged"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_feedback_stored: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FeedbackStored"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_feedback_undone: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FeedbackUndone"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_feedback_relabelled: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["FeedbackRelabelled"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_execution_started: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ExecutionStarted"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_execution_ended: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["ExecutionEnded"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_metrics_added: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["MetricsAdded"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_worker_changed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["WorkerChanged"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_robot_told: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["RobotTold"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_attendance_changed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["AttendanceChanged"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_incident_kept: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["IncidentKept"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_evaluation_changed: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["EvaluationChanged"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_acknowledged: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Acknowledged"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_refused: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Refused"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
    event_pong: {
        parameters: {
            query?: never;
            header?: never;
            path?: never;
            cookie?: never;
        };
        requestBody: {
            content: {
                "application/json": components["schemas"]["Pong"];
            };
        };
        responses: {
            /** @description Sent over the WebSocket; there is no answer to it */
            200: {
                headers: {
                    [name: string]: unknown;
                };
                content?: never;
            };
        };
    };
}

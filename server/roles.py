"""Which role each route and each message of the stream asks for: the one table of access.

A route or message that it doesn't name is refused to everybody, so that a new one can't be forgotten.
"""

from __future__ import annotations

from dataclasses import dataclass

from server.errors import ServiceError, problem
from server.principal import Principal, Role
from server.schemas_problems import Problem


@dataclass(frozen=True)
class Need:
    """What a route asks of whoever calls it."""

    role: Role | None
    """None: not even to be signed in."""
    shared: bool = False
    """Also for those who were invited to one experiment, although it belongs to none; it shows them their own part."""


OPEN = Need(None)
VIEWER, TRAINER, OPERATOR, OWNER = (Need(role) for role in Role)
ANYONE = Need(Role.VIEWER, shared=True)

NEEDS: dict[str, Need] = {
    # probes, the page, the description of the API: no secrets, and the page is where one signs in
    "health": OPEN,
    "ready": OPEN,
    "page": OPEN,
    "custom_swagger_ui_html": OPEN,
    "swagger_ui_redirect": OPEN,
    # coming in and going out
    "get_me": OPEN,
    "sign_in": OPEN,
    "sign_out": ANYONE,
    "make_token": ANYONE,
    # people; who may invite, and let out, also has to have the role that it is about
    "invite": OPERATOR,
    "list_invitations": OPERATOR,
    "revoke_invitation": OPERATOR,
    "list_people": OPERATOR,
    "update_person": OWNER,
    "revoke_person": OPERATOR,
    "list_present": VIEWER,
    "list_audit": OPERATOR,
    "export_audit": OPERATOR,
    # what can be chosen
    "list_tasks": ANYONE,
    "get_task": ANYONE,
    "list_adapters": ANYONE,
    "get_adapter": ANYONE,
    "list_algorithms": ANYONE,
    "get_algorithm": ANYONE,
    "list_teachers": ANYONE,
    "get_teacher": ANYONE,
    "get_paper_figures": ANYONE,
    # experiments
    "list_experiments": ANYONE,
    "create_experiment": OPERATOR,
    "get_experiment": VIEWER,
    "update_experiment": OPERATOR,
    "start_experiment": OPERATOR,
    "pause_experiment": OPERATOR,
    "resume_experiment": OPERATOR,
    "finish_experiment": OPERATOR,
    "reset_episode": OPERATOR,
    # a stop does no harm, and whoever can set the robot in motion must be able to stop it; but a link that is passed on
    # to onlookers must not be able to stop a laboratory
    "halt_experiment": TRAINER,
    "rearm_experiment": OPERATOR,
    "archive_experiment": OPERATOR,
    "evaluate_experiment": OPERATOR,
    # at a real robot
    "attend": OPERATOR,
    "leave": OPERATOR,
    "recover": OPERATOR,
    "home": OPERATOR,
    "get_camera_calibration": OPERATOR,
    "begin_camera_calibration": OPERATOR,
    "look_for_the_board": OPERATOR,
    "solve_camera_calibration": OPERATOR,
    "store_camera_calibration": OPERATOR,
    # proposals and clicks
    "stream": VIEWER,
    "next_proposal": TRAINER,
    "list_proposals": VIEWER,
    "get_proposal": VIEWER,
    "get_image": VIEWER,
    "give_feedback": TRAINER,
    "relabel_feedback": TRAINER,
    "undo_feedback": TRAINER,
    "list_feedback_of_proposal": VIEWER,
    "list_feedback": VIEWER,
    "get_feedback": VIEWER,
    "get_practice": TRAINER,
    "next_practice": TRAINER,
    "answer_practice": TRAINER,
    "get_practice_image": TRAINER,
    # what an experiment leaves behind
    "list_executions": VIEWER,
    "get_execution": VIEWER,
    "report_execution": TRAINER,
    "list_metrics": VIEWER,
    "export_metrics": VIEWER,
    "list_history": VIEWER,
    "get_timeline": VIEWER,
    "list_episodes": VIEWER,
    "get_episode": VIEWER,
    "get_critic_map": VIEWER,
    "get_considered": VIEWER,
    "list_events": VIEWER,
    "list_evaluations": VIEWER,
    "list_checkpoints": VIEWER,
    "list_incidents": VIEWER,
    "get_incident": VIEWER,
    "get_incident_frame": VIEWER,
    "get_curves": VIEWER,
    "get_calibration": VIEWER,
    "get_auto_approval": VIEWER,
    # one's own figures are one's own; everybody's are for those who run the experiment
    "get_own_figures": TRAINER,
    "get_quality": OPERATOR,
    "list_gold": OPERATOR,
    "mark_gold": OPERATOR,
    "unmark_gold": OPERATOR,
    "export_feedback": OPERATOR,
    "list_trainers": OPERATOR,
    # over all experiments
    "compare_experiments": VIEWER,
    "list_tags": ANYONE,
    "list_studies": VIEWER,
    "get_study": VIEWER,
    "get_study_file": VIEWER,
}
"""What each route asks, by its name (`operationId` in OpenAPI)."""

MESSAGES: dict[str, Role] = {
    "feedback": NEEDS["give_feedback"].role or Role.TRAINER,
    "relabel": NEEDS["relabel_feedback"].role or Role.TRAINER,
    "undo": NEEDS["undo_feedback"].role or Role.TRAINER,
    "halt": NEEDS["halt_experiment"].role or Role.TRAINER,
    "look": NEEDS["next_proposal"].role or Role.TRAINER,
    "frame_ack": Role.VIEWER,
    "ping": Role.VIEWER,
}
"""What each message of a client's stream asks, by its `type`; a message that isn't named is refused."""


def too_little(who: Principal, needed: Role) -> ServiceError | None:
    """What to answer someone whose role doesn't reach; None: it does."""
    if who.role.covers(needed):
        return None
    return ServiceError(
        403,
        f"{who.name} is here as {who.role.value}, and this needs the role {needed.value}",
        remedy=f"ask an owner for an invitation as {needed.value}",
    )


def refusal(who: Principal, kind: str) -> Problem | None:
    """Why someone may not send this message over the stream; None: they may."""
    needed = MESSAGES.get(kind)
    if needed is None:
        return problem(403, f"nobody may send {kind}", remedy="declare its role in server/roles.py")
    refused = too_little(who, needed)
    return None if refused is None else refused.problem

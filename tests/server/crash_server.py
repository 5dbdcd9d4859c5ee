"""A service without HTTP, to be killed: clicks by itself and says each thing that it has been acknowledged.

`python -m tests.server.crash_server DATA_DIR EXPERIMENT_ID SEED`
"""

from __future__ import annotations

import asyncio
import random
import sys
import uuid
from pathlib import Path

from server.messages import ExecutionStarted, FrameHeader, ProposalOpened, StreamEvent
from server.schemas import FeedbackCreate
from tests.server.stage import stage


def say(*words: object) -> None:
    """One line, at once."""
    print(*words, flush=True)


async def main(data_dir: Path, experiment_id: int, seed: int) -> None:
    """Judge every proposal at random until killed."""
    chance = random.Random(seed)
    async with stage(data_dir, checkpoint_every=5) as s:
        opened: asyncio.Queue[int] = asyncio.Queue()
        record, record_frame = s.seen.publish, s.seen.publish_frame

        def publish(experiment: int, event: StreamEvent) -> None:
            record(experiment, event)
            if isinstance(event, ProposalOpened):
                opened.put_nowait(event.proposal.id)
            elif isinstance(event, ExecutionStarted):
                say("started", event.execution.proposal_id)

        def publish_frame(experiment: int, header: FrameHeader, jpeg: bytes) -> None:
            record_frame(experiment, header, jpeg)
            say("moving", header.execution_id)

        s.seen.publish, s.seen.publish_frame = publish, publish_frame  # type: ignore[method-assign,assignment]
        lifecycle = (await s.hub.view(experiment_id)).lifecycle
        await s.hub.act(experiment_id, "start" if lifecycle == "created" else "resume")
        while True:
            proposal_id = await opened.get()
            value = chance.choice((-1, -1, 0, 1))
            click = FeedbackCreate(click_id=uuid.uuid4().hex, value=value)
            await s.hub.feedback(proposal_id, click)
            say("stored", click.click_id, proposal_id, value)


if __name__ == "__main__":
    asyncio.run(main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])))

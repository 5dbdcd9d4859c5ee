// The live pictures of each robot's newest motion, kept to be looked at again, slowly.
import type { Frame } from "./frames";
import type { Shot } from "./player";

/** About three quarters of a minute of two cameras; what is older is dropped. */
const MOST = 900;

interface Motion {
  execution: number | null;
  frames: Frame[];
}

export class Recording {
  private readonly motions = new Map<number, Motion>();

  keep(frame: Frame): void {
    const { robot, execution_id: execution } = frame.header;
    let motion = this.motions.get(robot);
    if (motion?.execution !== execution) {
      motion = { execution, frames: [] };
      this.motions.set(robot, motion);
    }
    motion.frames.push(frame);
    if (motion.frames.length > MOST) motion.frames.shift();
  }

  /** The pictures of one execution, oldest first; none where this page didn't watch it. */
  of(robot: number, execution: number): Shot[] {
    const motion = this.motions.get(robot);
    if (motion?.execution !== execution) return [];
    return motion.frames.map(({ header, jpeg }) => ({
      camera: header.camera,
      at: header.taken_at,
      width: header.width,
      height: header.height,
      source: jpeg,
    }));
  }
}

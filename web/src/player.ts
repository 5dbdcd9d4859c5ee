// A motion to be played again: which picture each camera shows at a time. Pure.

export interface Shot {
  camera: string;
  /** Seconds since the epoch. */
  at: number;
  width: number;
  height: number;
  /** The JPEG itself, or where it can be had. */
  source: Blob | string;
}

export interface Reel {
  /** Seconds from the first picture to the last. */
  length: number;
  /** Of each camera in the order of their names, its pictures oldest first, by seconds from the beginning. */
  tracks: { camera: string; width: number; height: number; shots: { at: number; source: Blob | string }[] }[];
}

export function reelOf(shots: Shot[]): Reel {
  const ordered = [...shots].sort((one, other) => one.at - other.at);
  const [first] = ordered;
  const begin = first?.at ?? 0;
  const cameras = [...new Set(ordered.map(({ camera }) => camera))].sort();
  const tracks = cameras.map((camera) => {
    const own = ordered.filter((shot) => shot.camera === camera);
    const [{ width, height } = { width: 4, height: 3 }] = own;
    return { camera, width, height, shots: own.map(({ at, source }) => ({ at: at - begin, source })) };
  });
  return { length: (ordered.at(-1)?.at ?? begin) - begin, tracks };
}

/** The newest picture of a track at a time; before its first, the first. */
export function shotAt(track: Reel["tracks"][number], time: number): Blob | string | null {
  let found = track.shots[0]?.source ?? null;
  for (const { at, source } of track.shots) {
    if (at > time + 1e-6) break;
    found = source;
  }
  return found;
}

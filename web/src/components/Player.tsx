// Plays a motion again, slowly if wanted: the live pictures of an execution, or those kept of an incident.
import { useEffect, useEffectEvent, useMemo, useState } from "react";
import { cameraName, t } from "../i18n";
import { decimal } from "../i18n/numbers";
import { type Reel, reelOf, type Shot, shotAt } from "../player";

const SPEEDS = [0.1, 0.25, 0.5, 1];

/** An address for each picture; those of pictures in memory are given back at the end. */
function useAddresses(reel: Reel): Map<Blob | string, string> {
  const [addresses, setAddresses] = useState(new Map<Blob | string, string>());
  useEffect(() => {
    const made = new Map<Blob | string, string>();
    for (const { shots } of reel.tracks)
      for (const { source } of shots)
        made.set(source, typeof source === "string" ? source : URL.createObjectURL(source));
    setAddresses(made);
    return () => {
      for (const [source, address] of made) if (typeof source !== "string") URL.revokeObjectURL(address);
    };
  }, [reel]);
  return addresses;
}

/** Seconds into the reel, running on at a speed while it plays. */
function useClock(length: number) {
  const [time, setTime] = useState(0);
  const [playing, setPlaying] = useState(true);
  const [speed, setSpeed] = useState(0.25);
  const advance = useEffectEvent((by: number) => {
    const next = time + by * speed;
    setTime(Math.min(length, next));
    if (next >= length) setPlaying(false);
  });
  useEffect(() => {
    if (!playing) return;
    let last = performance.now();
    let frame = requestAnimationFrame(function tick(now) {
      advance((now - last) / 1000);
      last = now;
      frame = requestAnimationFrame(tick);
    });
    return () => cancelAnimationFrame(frame);
  }, [playing]);
  const toggle = () => {
    if (!playing && time >= length) setTime(0);
    setPlaying(!playing);
  };
  const seek = (to: number) => {
    setPlaying(false);
    setTime(to);
  };
  return { time, playing, speed, setSpeed, toggle, seek };
}

export function Player({ shots }: { shots: Shot[] }) {
  const reel = useMemo(() => reelOf(shots), [shots]);
  const addresses = useAddresses(reel);
  const { time, playing, speed, setSpeed, toggle, seek } = useClock(reel.length);
  return (
    <div className="player" data-testid="player" data-time={time.toFixed(2)}>
      <div className="pictures">
        {reel.tracks.map((track) => {
          const source = shotAt(track, time);
          const address = source && addresses.get(source);
          return (
            <figure
              key={track.camera}
              className="pictured"
              style={{ aspectRatio: `${track.width} / ${track.height}` }}
            >
              {address && (
                <img src={address} alt={t("player.picture", { camera: cameraName(track.camera) })} />
              )}
              <figcaption className="chip camera">{cameraName(track.camera)}</figcaption>
            </figure>
          );
        })}
      </div>
      <div className="transport">
        <button type="button" className="button" onClick={toggle} data-first data-testid="play">
          {playing ? t("player.pause") : t("player.play")}
        </button>
        <input
          type="range"
          min={0}
          max={Math.max(reel.length, 0.01)}
          step={0.05}
          value={time}
          aria-label={t("player.position")}
          aria-valuetext={t("player.at", { time: decimal(time, 1), length: decimal(reel.length, 1) })}
          onChange={(event) => seek(Number(event.target.value))}
        />
        <span className="number soft">
          {t("player.at", { time: decimal(time, 1), length: decimal(reel.length, 1) })}
        </span>
        <label className="speed">
          <span className="sr-only">{t("player.speed")}</span>
          <select value={speed} onChange={(event) => setSpeed(Number(event.target.value))}>
            {SPEEDS.map((each) => (
              <option key={each} value={each}>
                {t("player.times", {
                  speed: decimal(each, each < 0.2 || each === 0.5 ? 1 : each < 1 ? 2 : 0),
                })}
              </option>
            ))}
          </select>
        </label>
      </div>
    </div>
  );
}

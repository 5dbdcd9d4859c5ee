// The next proposal announces itself by a sound or a tap, for whoever asked for that.
import { settings } from "./settings";

let context: AudioContext | null = null;

/** A short, soft tone. A browser lets a page sound only after a first press on it; until then it stays silent. */
function tone(): void {
  try {
    context ??= new AudioContext();
    const now = context.currentTime;
    const gain = context.createGain();
    gain.gain.setValueAtTime(0.0001, now);
    gain.gain.exponentialRampToValueAtTime(0.08, now + 0.01);
    gain.gain.exponentialRampToValueAtTime(0.0001, now + 0.12);
    const oscillator = context.createOscillator();
    oscillator.frequency.value = 660;
    oscillator.connect(gain).connect(context.destination);
    oscillator.start(now);
    oscillator.stop(now + 0.13);
  } catch (error) {
    console.error("This device can't sound", error);
  }
}

export function announce(): void {
  const { sound, haptic } = settings();
  if (sound) tone();
  if (haptic) navigator.vibrate?.(20);
}

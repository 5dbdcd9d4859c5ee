// No overlay on a picture that it wasn't made for.
import { act } from "react";
import { describe, expect, it } from "vitest";
import { useDrawn, Views } from "../src/components/Views";
import { FrameSink } from "../src/frames";
import { ImageStore } from "../src/images";
import type { Proposal } from "../src/wire";
import { proposal } from "./messages";
import { byTestId, show } from "./render";

const frames = new FrameSink();

function Page({ images, current }: { images: ImageStore; current: Proposal }) {
  const { drawn, failed } = useDrawn(images, current);
  return (
    <Views
      images={images}
      frames={frames}
      drawn={drawn}
      failed={failed}
      overlay={drawn === current}
      accepting={false}
      robot={0}
      live={null}
      moving={false}
      skill={drawn === current ? current.skill : null}
      empty="Nothing yet"
    />
  );
}

/** A store whose pictures are decoded when the test says so. */
function pictures() {
  const waiting: (() => void)[] = [];
  const images = new ImageStore(
    () =>
      new Promise((resolve) => {
        waiting.push(() => resolve({ close: () => undefined } as unknown as ImageBitmap));
      }),
  );
  const decode = (count: number) =>
    act(async () => {
      for (const done of waiting.splice(0, count)) done();
    });
  return { images, decode };
}

const moved = (id: number) =>
  proposal(id, { views: proposal(id).views.map((view) => ({ ...view, image: `${view.image}-moved` })) });

describe("views", () => {
  it("draws nothing before both pictures are decoded, then everything", async () => {
    const { images, decode } = pictures();
    await show(<Page images={images} current={proposal(1)} />);
    await decode(1);
    expect(document.querySelector(".overlay")).toBeNull();
    expect(byTestId("views").dataset.proposalId).toBeUndefined();
    await decode(1);
    expect(document.querySelectorAll(".overlay").length).toBe(2);
    expect(byTestId("views").dataset.proposalId).toBe("1");
  });

  it("draws another proposal on the same pictures at once", async () => {
    const { images, decode } = pictures();
    await show(<Page images={images} current={proposal(1)} />);
    await decode(2);
    await show(<Page images={images} current={proposal(2)} />);
    expect(byTestId("views").dataset.proposalId).toBe("2");
  });

  it("takes the old overlay away while the new pictures are still coming", async () => {
    const { images, decode } = pictures();
    await show(<Page images={images} current={proposal(1)} />);
    await decode(2);
    await show(<Page images={images} current={moved(2)} />);
    expect(document.querySelector(".overlay")).toBeNull();
    expect(byTestId("views").dataset.proposalId).toBeUndefined();
    await decode(2);
    expect(byTestId("views").dataset.proposalId).toBe("2");
    expect(document.querySelectorAll(".overlay").length).toBe(2);
  });

  it("never leaves what is to be judged outside of a zoomed picture, and zooms again as it was chosen", async () => {
    const { images, decode } = pictures();
    const at = (id: number, dot: [number, number]) =>
      proposal(id, {
        views: proposal(id).views.map((view) => ({ ...view, overlay: { ...view.overlay, dot } })),
      });
    const seen = () => [
      byTestId("view-left").dataset.zoomed,
      document.querySelector(".chip.note")?.textContent,
    ];
    await show(<Page images={images} current={at(1, [320, 240])} />);
    await decode(2);
    for (let time = 0; time < 3; time += 1) await act(async () => byTestId("nearer-left").click());
    expect(seen()).toEqual(["true", undefined]);
    await show(<Page images={images} current={at(2, [10, 20])} />);
    expect(seen()).toEqual(["false", "Outside your zoom: shown whole"]);
    expect(byTestId("view-right").textContent).not.toContain("Outside");
    await show(<Page images={images} current={at(3, [300, 250])} />);
    expect(seen()).toEqual(["true", undefined]);
    await show(<Page images={images} current={at(4, [10, 20])} />);
    await act(async () => byTestId("nearer-left").click()); // chosen anew: what was kept is forgotten
    expect(seen()).toEqual(["true", undefined]);
    await act(async () => byTestId("nearer-left").click());
    await show(<Page images={images} current={at(5, [320, 240])} />);
    await act(async () => document.querySelector<HTMLElement>("[aria-label^='Show all']")?.click());
    await show(<Page images={images} current={at(6, [10, 20])} />);
    expect(seen()).toEqual(["false", undefined]);
  });

  it.each([
    ["Good", 100, 0],
    ["Bad", -100, 0],
    ["Neutral", 0, -100],
  ])("says what a stroke would say before the finger is lifted: %s", async (word, across, down) => {
    const { images, decode } = pictures();
    await show(<Page images={images} current={proposal(1)} />);
    await decode(2);
    const view = byTestId("view-left");
    const finger = { pointerId: 1, pointerType: "touch", bubbles: true };
    const at = (clientX: number, clientY: number) => ({ ...finger, clientX, clientY });
    const send = (type: string, where: PointerEventInit) =>
      act(async () => view.dispatchEvent(new PointerEvent(type, where)));
    await send("pointerdown", at(200, 200));
    await send("pointermove", at(200 + across, 200 + down));
    expect(view.dataset.said).toBe(word);
    await send("pointercancel", at(200, 200));
    expect(view.dataset.said).toBeUndefined();
  });
});

// The scene drawn in 3-D from the state alone: table, objects, and the gripper where the proposal would bring it.
// Loaded apart from the page, together with three.js. Metres, robot base frame: x forward, y left, z up.
import {
  AmbientLight,
  BoxGeometry,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  EdgesGeometry,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Scene,
  SphereGeometry,
  TorusGeometry,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { themeColor } from "./theme";
import type { Proposal, SceneInfo } from "./wire";

type Solid = SceneInfo["objects"][number]["parts"][number];

const TABLE_HALF = 0.4; // m, robosuite's table
const FINGER = { half: [0.01, 0.008, 0.029], up: 0.018 } as const; // the Franka hand, as in the stored ghost
const HAND = { half: [0.0315, 0.102, 0.033], up: 0.078 } as const;
const OPEN = 0.08;
const EYE = new Vector3(1.2, -0.62, 0.5);

function box(half: readonly [number, number, number], color: Color | string, opacity = 1): Mesh {
  const material = new MeshLambertMaterial({ color, transparent: opacity < 1, opacity });
  return new Mesh(new BoxGeometry(2 * half[0], 2 * half[1], 2 * half[2]), material);
}

function solid({ shape, half, centre, colour, opacity }: Solid): Mesh {
  const color = new Color().setRGB(...colour, "srgb");
  const material = new MeshLambertMaterial({ color, transparent: opacity < 1, opacity });
  const [radius, , height] = half;
  let mesh: Mesh;
  if (shape === "sphere") mesh = new Mesh(new SphereGeometry(radius, 32, 20), material);
  else if (shape === "box") mesh = box(half, color, opacity);
  else {
    const geometry =
      shape === "disc"
        ? new CylinderGeometry(radius, radius, 2 * height, 40)
        : new TorusGeometry(radius * 0.85, radius * 0.12, 10, 40);
    mesh = new Mesh(geometry, material);
    if (shape === "disc") mesh.rotation.x = Math.PI / 2; // three's cylinders stand along y
  }
  mesh.position.set(...centre);
  return mesh;
}

function gripper(): { group: Group; open: (by: number) => void } {
  const group = new Group();
  const color = themeColor("--accent");
  const fingers = [-1, 1].map((side) => {
    const finger = box(FINGER.half, color, 0.75);
    finger.position.set(0, 0, FINGER.up);
    group.add(finger);
    return { finger, side };
  });
  const hand = box(HAND.half, color, 0.45);
  hand.position.set(0, 0, HAND.up);
  group.add(hand);
  const open = (by: number) => {
    for (const { finger, side } of fingers) finger.position.y = side * (by / 2 + FINGER.half[1]);
  };
  return { group, open };
}

/** Where the state has an object; null where nothing tells. */
export function placeOf(
  object: SceneInfo["objects"][number],
  state: number[],
  table: number,
): [number, number, number] | null {
  if (object.slides_at !== null && object.fixed) {
    const [x, y, z] = object.fixed;
    return [x - (state[object.slides_at] ?? 0), y, z];
  }
  if (object.state_at === null) return object.fixed;
  const x = state[object.state_at];
  const y = state[object.state_at + 1];
  if (x === undefined || y === undefined) return object.fixed;
  const z = object.state_size > 2 ? state[object.state_at + 2] : undefined;
  return [x, y, z ?? table + object.rests];
}

/** Draws into a canvas until it is disposed of; renders only when something has changed. */
export class SceneDrawing {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(38, 4 / 3, 0.05, 10);
  private readonly controls: OrbitControls;
  private readonly objects = new Map<string, Group>();
  private readonly hand = gripper();
  private readonly now = gripper();
  private readonly way: Line;
  private due = 0;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly info: SceneInfo,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    const [cx, cy] = info.table_centre;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enablePan = false;
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 3;
    this.controls.maxPolarAngle = 0.49 * Math.PI;
    this.controls.addEventListener("change", () => this.draw());
    this.way = new Line(
      new BufferGeometry().setFromPoints([new Vector3(), new Vector3()]),
      new LineBasicMaterial({ color: themeColor("--overlay-dot") }),
    );
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(0.6, -0.8, 2);
    this.scene.add(new AmbientLight(0xffffff, 1.3), sun, this.hand.group, this.now.group, this.way);
    const top = box([TABLE_HALF, TABLE_HALF, 0.02], themeColor("--scene-table"));
    top.position.set(cx, cy, info.table_height - 0.02);
    this.scene.add(top);
    if (info.workspace) this.scene.add(this.room(...info.workspace));
    for (const object of info.objects) {
      const group = new Group();
      for (const part of object.parts) group.add(solid(part));
      this.objects.set(object.name, group);
      this.scene.add(group);
    }
    this.home();
  }

  /** Back to the first view. */
  home(): void {
    const [cx, cy] = this.info.table_centre;
    this.camera.position.copy(EYE);
    this.controls.target.set(cx, cy, this.info.table_height + 0.05);
    this.controls.update();
    this.draw();
  }

  /** Around the table, by an angle in radians; up or down by another. */
  turn(around: number, up = 0): void {
    const from = this.camera.position.clone().sub(this.controls.target);
    const flat = Math.hypot(from.x, from.y);
    const height = Math.min(1.5, Math.max(0.05, Math.atan2(from.z, flat) + up));
    const angle = Math.atan2(from.y, from.x) + around;
    const far = from.length();
    this.camera.position
      .set(
        far * Math.cos(height) * Math.cos(angle),
        far * Math.cos(height) * Math.sin(angle),
        far * Math.sin(height),
      )
      .add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  /** A proposal's state, and, if it is `wanted`, what it would do. */
  show(proposal: Proposal, wanted: boolean): void {
    const { state, parameters, skill } = proposal;
    for (const object of this.info.objects) {
      const place = placeOf(object, state, this.info.table_height);
      const group = this.objects.get(object.name);
      if (!group) continue;
      group.visible = place !== null;
      if (place) group.position.set(...place);
    }
    const at = this.info.gripper_at;
    this.now.group.visible = at !== null;
    if (at !== null) this.now.group.position.set(state[at] ?? 0, state[at + 1] ?? 0, state[at + 2] ?? 0);
    this.now.open(OPEN);
    const { x, y, z, direction = 0, delta = 0, yaw } = parameters;
    const acts = wanted && x !== undefined && y !== undefined && z !== undefined;
    this.hand.group.visible = acts;
    this.way.visible = acts;
    if (acts) {
      const pushes = skill === "push";
      const target = new Vector3(x, y, z);
      const end = pushes
        ? new Vector3(direction < 0 ? x + delta : x, direction < 0 ? y : y + delta, z)
        : new Vector3(x, y, this.info.table_height);
      this.hand.group.position.copy(pushes ? end : target);
      this.hand.group.rotation.z = yaw ?? proposal.views[0]?.overlay.yaw ?? 0;
      this.hand.open(pushes || skill === "reach" ? 0 : OPEN);
      this.way.geometry.setFromPoints([target, end]);
    }
    this.draw();
  }

  size(width: number, height: number): void {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  dispose(): void {
    cancelAnimationFrame(this.due);
    this.controls.dispose();
    this.scene.traverse((each) => {
      if (!(each instanceof Mesh || each instanceof Line)) return;
      each.geometry.dispose();
      (each.material as Material).dispose();
    });
    this.renderer.dispose();
  }

  private draw(): void {
    cancelAnimationFrame(this.due);
    this.due = requestAnimationFrame(() => this.renderer.render(this.scene, this.camera));
  }

  private room(low: [number, number, number], high: [number, number, number]): LineSegments {
    const [a, b] = [new Vector3(...low), new Vector3(...high)];
    const size = b.clone().sub(a);
    const edges = new LineSegments(
      new EdgesGeometry(new BoxGeometry(size.x, size.y, size.z)),
      new LineBasicMaterial({ color: themeColor("--scene-room"), transparent: true, opacity: 0.7 }),
    );
    edges.position.copy(a.add(b).multiplyScalar(0.5));
    return edges;
  }
}

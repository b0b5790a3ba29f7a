// A body as triangles for WebGL, deformed and coloured, and the way back from a place on the screen to
// the nodes.
import * as THREE from 'three';
import { Field, Grid, Result } from './results';
import { featureEdges } from './feature_edges';
import { inOrderOfPainting } from './setting';
import { levelOf } from './colour_scale';
import { mapBytes, mapHex, Range } from './colours';
import { isolines } from './isolines';
import { suitableMagnification } from './magnification';

/** What is to be seen of a body. */
export interface Look {
  /** -1: none, which `missing` explains */
  state: number;
  missing?: string;
  scale: number;
  mesh: boolean;
  field?: Field;
  component: string;
  range: Range;
  /** of the colours; 0: none */
  bands?: number;
  /** places on the colour bar with lines of equal values */
  levels?: number[];
  /** shades a solid body by its slopes, which darkens colours; without, its edges show its shape */
  light?: boolean;
}

const vertexShader = `
  attribute float level;
  attribute float missing;
  varying float vLevel;
  varying float vMissing;
  varying vec3 vPlace;
  void main() {
    vLevel = level;
    vMissing = missing;
    vec4 place = modelViewMatrix * vec4(position, 1.0);
    vPlace = place.xyz;
    gl_Position = projectionMatrix * place;
  }`;
const fragmentShader = `
  uniform sampler2D colours;
  uniform float shade;
  uniform vec3 plain;
  uniform float coloured;
  varying float vLevel;
  varying float vMissing;
  varying vec3 vPlace;
  void main() {
    vec3 normal = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
    float light = mix(1.0, 0.62 + 0.38 * abs(normal.z), shade);
    vec3 colour = texture2D(colours, vec2(clamp(vLevel, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
    gl_FragColor = vec4(mix(plain, colour, vMissing > 0.0 ? 0.0 : coloured) * light, 1.0);
  }`;

/** Of each corner the place on the colour bar, and whether there is no value. */
function setColours(geometry: THREE.BufferGeometry, corners: number) {
  for (const name of ['level', 'missing'])
    geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(corners), 1));
}

const textures = new Map<string, THREE.DataTexture>();

function colourTexture(signed: boolean, bands: number): THREE.DataTexture {
  const hex = mapHex(signed, bands);
  let texture = textures.get(hex);
  if (!texture) {
    texture = new THREE.DataTexture(mapBytes(signed, bands), 256, 1);
    texture.magFilter = texture.minFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    textures.set(hex, texture);
  }
  return texture;
}

export class Body {
  readonly scene = new THREE.Scene();
  readonly grid: Grid;
  /** middle and largest extent of the undeformed body [m]; the scene is measured in that extent */
  readonly centre: [number, number, number];
  readonly size: number;
  private readonly extents: number[];
  /** places of the nodes in the scene, deformed */
  readonly places: Float32Array;
  private readonly material: THREE.ShaderMaterial;
  // Of fields at nodes triangles share their corners; of fields in cells each has corners of its own.
  private readonly smooth = new THREE.BufferGeometry();
  private flat?: THREE.BufferGeometry;
  private readonly lines = new THREE.BufferGeometry();
  private readonly lineMaterial = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.35 });
  private readonly lineObject: THREE.LineSegments;
  private readonly isolineObject = new THREE.LineSegments(undefined, new THREE.LineBasicMaterial({ color: '#000000' }));
  private readonly ridges = new THREE.BufferGeometry();
  private readonly ridgeObject: THREE.LineSegments;
  readonly settingObject = new THREE.Group();
  private readonly triangleObject: THREE.Mesh;
  private scale?: number;
  private placed = '';
  private spread = false;
  private coloured = '';

  /** `shape`: whose displacements deform it; `whole`: what it is a part of, at whose place and as large it stands */
  constructor(readonly result: Result, private readonly shape = result, private readonly whole?: Body) {
    this.grid = result.grid!;
    [this.centre, this.extents] = whole ? [whole.centre, whole.extents] : extentOf(this.grid.points);
    this.size = Math.max(...this.extents);
    this.places = new Float32Array(this.grid.points.length);
    this.material = new THREE.ShaderMaterial({
      vertexShader, fragmentShader, side: THREE.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      uniforms: {
        colours: { value: colourTexture(false, 0) }, shade: { value: 0 },
        plain: { value: new THREE.Vector3() }, coloured: { value: 1 },
      },
    });
    const corners = new THREE.BufferAttribute(this.places, 3);
    this.smooth.setAttribute('position', corners);
    setColours(this.smooth, this.places.length / 3);
    this.smooth.setIndex(new THREE.BufferAttribute(this.grid.triangles, 1));
    this.lines.setAttribute('position', corners);
    this.lines.setIndex(new THREE.BufferAttribute(this.grid.edges, 1));
    this.triangleObject = new THREE.Mesh(this.smooth, this.material);
    this.lineObject = new THREE.LineSegments(this.lines, this.lineMaterial);
    this.ridges.setAttribute('position', corners);
    this.ridgeObject = new THREE.LineSegments(this.ridges, new THREE.LineBasicMaterial({ color: '#000000', transparent: true, opacity: 0.6 }));
    this.ridgeObject.visible = false;
    for (const object of [this.triangleObject, this.lineObject, this.isolineObject, this.ridgeObject]) object.frustumCulled = false;
    this.scene.add(this.triangleObject, this.lineObject, this.isolineObject, this.ridgeObject, this.settingObject);
  }

  /** The greatest displacement over all states [m]. */
  get largestDisplacement(): number {
    return this.shape.field('displacement')?.values('size').greatest ?? 0;
  }

  /** Where it begins and ends along an axis, undeformed [m]. */
  ends(axis: number): [number, number] {
    return [this.centre[axis] - this.extents[axis] / 2, this.centre[axis] + this.extents[axis] / 2];
  }

  /** Gives back what the graphics hold of it. */
  dispose() {
    for (const geometry of [this.smooth, this.flat, this.lines, this.ridges, this.isolineObject.geometry]) geometry?.dispose();
  }

  /** Whether its extents, in units of the largest one, are those of the other body, to a hundredth. */
  isShapedLike(other: Body): boolean {
    return this.result.dimension === other.result.dimension &&
      this.extents.every((v, c) => Math.abs(v / this.size - other.extents[c] / other.size) < 0.01);
  }

  /** Magnification of displacements that shows them well and folds no cell. */
  get suitableScale(): number {
    this.scale ??= this.whole?.suitableScale ?? suitableMagnification(this.grid, this.size, this.shape.field('displacement'), this.shape.field('strain'),
      !!this.shape.solid);
    return this.scale;
  }

  set(look: Look, ink: string, paper: string) {
    this.place(look.state, look.scale);
    this.triangleObject.geometry = look.field && !look.field.onPoints ? this.apart() : this.smooth;
    this.colour(look);
    this.lineObject.visible = look.mesh;
    this.ridgeObject.visible = this.result.dimension === 3 && !!look.field;
    if (this.ridgeObject.visible && !this.ridges.index) this.ridges.setIndex(new THREE.BufferAttribute(featureEdges(this.grid), 1));
    this.material.uniforms.shade.value = this.result.dimension === 3 && (!look.field || look.light) ? 1 : 0;
    this.lineMaterial.color.set(look.field ? '#000000' : ink);
    this.lineMaterial.opacity = look.field ? 0.17 : 0.5;
    const plain = new THREE.Color(paper);
    (this.material.uniforms.plain.value as THREE.Vector3).set(plain.r, plain.g, plain.b);
    this.material.uniforms.coloured.value = look.field ? 1 : 0;
    this.material.uniforms.colours.value = colourTexture(look.range.signed, look.bands ?? 0);
    this.line(look);
  }

  /** What the body covers of the scene over all states; of a thin body the arrows of its poling reach beyond it. */
  reach(scale: number, arrows: boolean): { low: number[]; high: number[] } {
    const low = [0, 0, 0], high = [0, 0, 0];
    const cover = (at: number, c: number) => {
      low[c] = Math.min(low[c], at);
      high[c] = Math.max(high[c], at);
    };
    const { points } = this.grid;
    const displacement = this.shape.field('displacement');
    ['x', 'y', 'z'].forEach((axis, c) => {
      const u = displacement?.has(axis) ? displacement.values(axis).data : new Float32Array(points.length / 3);
      for (let i = 0, node = c; i < u.length; ++i, node = node + 3 < points.length ? node + 3 : c)
        cover((points[node] - this.centre[c] + scale * u[i]) / this.size, c);
    });
    if (arrows && this.result.poling) this.inScene(this.result.poling).forEach((at, i) => cover(at, i % 3));
    return { low, high };
  }

  place(state: number, scale: number) {
    const key = `${state} ${scale}`;
    if (key === this.placed) return;
    this.placed = key;
    const { points } = this.grid;
    const displacement = this.shape.field('displacement');
    const n = points.length / 3;
    ['x', 'y', 'z'].forEach((axis, c) => {
      const u = scale !== 0 && displacement?.has(axis) ? displacement.values(axis).data : undefined;
      for (let i = 0, k = c, at = state * n; i < n; ++i, k += 3, ++at)
        this.places[k] = (points[k] - this.centre[c] + (u ? scale * u[at] : 0)) / this.size;
    });
    this.smooth.getAttribute('position').needsUpdate = true;
    this.spread = false;
  }

  // The triangles with corners of their own, where the nodes are.
  private apart(): THREE.BufferGeometry {
    const { triangles } = this.grid;
    if (!this.flat) {
      this.flat = new THREE.BufferGeometry();
      this.flat.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * triangles.length), 3));
      setColours(this.flat, triangles.length);
    }
    if (this.spread) return this.flat;
    this.spread = true;
    const attribute = this.flat.getAttribute('position') as THREE.BufferAttribute;
    const to = attribute.array as Float32Array;
    for (let i = 0; i < triangles.length; ++i)
      for (let c = 0; c < 3; ++c) to[3 * i + c] = this.places[3 * triangles[i] + c];
    attribute.needsUpdate = true;
    return this.flat;
  }

  private colour(look: Look) {
    if (!look.field) return;
    const key = `${look.state} ${look.field.name} ${look.component} ${look.range.low} ${look.range.high} ${!!look.range.logarithmic}`;
    if (key === this.coloured) return;
    this.coloured = key;
    const { data, places } = look.field.values(look.component);
    const [attribute, absent] = ['level', 'missing'].map((name) => this.triangleObject.geometry.getAttribute(name) as THREE.BufferAttribute);
    const to = attribute.array as Float32Array, missing = absent.array as Float32Array;
    const first = look.state * places, { low, high, logarithmic } = look.range;
    for (let i = 0; i < to.length; ++i) {
      const place = look.field.onPoints ? i : this.grid.triangleCells[(i / 3) | 0];
      const value = data[first + place];
      missing[i] = Number.isNaN(value) ? 1 : 0;
      to[i] = missing[i] ? 0 : logarithmic ? levelOf(look.range, value) : (value - low) / (high - low);
    }
    attribute.needsUpdate = absent.needsUpdate = true;
  }

  private line(look: Look) {
    this.isolineObject.visible = !!look.levels?.length;
    if (!this.isolineObject.visible) return;
    this.isolineObject.geometry.dispose();
    this.isolineObject.geometry = new THREE.BufferGeometry();
    this.isolineObject.geometry.setAttribute('position', new THREE.BufferAttribute(isolines(this, look, look.levels!), 3));
  }

  /** Facets of the boundaries as coloured surfaces, for three dimensions. */
  paintBoundaries(colours: Map<string, string>) {
    this.settingObject.clear();
    for (const boundary of inOrderOfPainting(this.result, colours)) {
      const positions: number[] = [];
      for (const facet of boundary.facets)
        for (let i = 2; i < facet.length; ++i)
          for (const node of [facet[0], facet[i - 1], facet[i]])
            for (let c = 0; c < 3; ++c)
              positions.push((this.grid.points[3 * node + c] - this.centre[c]) / this.size);
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(positions), 3));
      const colour = new THREE.Color(colours.get(boundary.name));
      const material = this.material.clone();
      material.polygonOffset = false;  // in front of the body, whose faces without a name stay bare
      material.uniforms.plain = { value: new THREE.Vector3(colour.r, colour.g, colour.b) };
      material.uniforms.coloured = { value: 0 };
      material.uniforms.shade = { value: 1 };
      setColours(geometry, positions.length / 3);
      this.settingObject.add(new THREE.Mesh(geometry, material));
    }
  }

  /** Shows the coloured facets upon the bare body. */
  showSetting(on: boolean) { this.settingObject.visible = on; }

  /** A triangle under a place in normalised device coordinates, the one in front. */
  pick(x: number, y: number, camera: THREE.Camera): Hit | undefined {
    const projected = this.project(camera);
    const { triangles } = this.grid;
    let best: Hit | undefined;
    let depth = Infinity;
    for (let t = 0; t < triangles.length / 3; ++t) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[3 * t + k]);
      const ux = projected[b] - projected[a], uy = projected[b + 1] - projected[a + 1];
      const vx = projected[c] - projected[a], vy = projected[c + 1] - projected[a + 1];
      const area = ux * vy - uy * vx;
      if (area === 0) continue;
      const px = x - projected[a], py = y - projected[a + 1];
      const second = (px * vy - py * vx) / area, third = (ux * py - uy * px) / area;
      if (second < 0 || third < 0 || second + third > 1) continue;
      const weights: [number, number, number] = [1 - second - third, second, third];
      const z = weights[0] * projected[a + 2] + weights[1] * projected[b + 2] + weights[2] * projected[c + 2];
      if (z >= depth) continue;
      depth = z;
      best = { triangle: t, weights };
    }
    return best;
  }

  /** Places of the undeformed body [m] in the scene. */
  inScene(points: Float32Array): Float32Array {
    return points.map((v, i) => (v - this.centre[i % 3]) / this.size);
  }

  /** Normalised device coordinates of places in the scene, of all nodes when none are given. */
  project(camera: THREE.Camera, places = this.places): Float32Array {
    const m = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    const result = new Float32Array(places.length);
    for (let i = 0; i < result.length; i += 3) {
      const x = places[i], y = places[i + 1], z = places[i + 2];
      for (let r = 0; r < 3; ++r) result[i + r] = m[r] * x + m[4 + r] * y + m[8 + r] * z + m[12 + r];
    }
    return result;
  }
}

/** A place on the skin: a triangle and the weights of its corners. */
export interface Hit { triangle: number; weights: [number, number, number] }

/** The value of a field's component at a place. */
export function valueAt(grid: Grid, field: Field, component: string, state: number, hit: Hit): number {
  const parts = component === 'size' && field.onPoints ? field.partsOfSize : [];
  if (parts.length > 0) return Math.hypot(...parts.map((part) => valueAt(grid, field, part, state, hit)));
  const { data, places } = field.values(component);
  const first = state * places;
  if (!field.onPoints) return data[first + grid.triangleCells[hit.triangle]];
  let sum = 0;
  for (let k = 0; k < 3; ++k)
    if (hit.weights[k] !== 0) sum += hit.weights[k] * data[first + grid.triangles[3 * hit.triangle + k]];
  return sum;
}

/** Middle and extents along the axes. */
function extentOf(points: Float32Array): [[number, number, number], number[]] {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; ++i) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  const middle = low.map((v, c) => (v + high[c]) / 2) as [number, number, number];
  return [middle, low.map((v, c) => high[c] - v)];
}

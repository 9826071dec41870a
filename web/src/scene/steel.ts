import {
  AlwaysDepth,
  DataTexture,
  DataUtils,
  EquirectangularReflectionMapping,
  HalfFloatType,
  LinearFilter,
  MeshStandardMaterial,
  RGBAFormat,
  ShaderMaterial,
  type Texture,
} from 'three';

const roomWide = 64;
const roomHigh = 32;

/** Polished or brushed steel that mirrors a room. */
export function steelMaterial(colour: number, roughness: number, room: Texture): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ color: colour, roughness, metalness: 0.92 });
  material.envMap = room;
  material.envMapIntensity = 1.05;
  // The room's y is up; superior is z.
  material.envMapRotation.set(Math.PI / 2, 0, 0);
  return material;
}

/** What steel mirrors: bright ceiling lamps, pale walls, a dark floor. */
export function operatingRoom(): DataTexture {
  const data = new Uint16Array(4 * roomWide * roomHigh);
  for (let row = 0; row < roomHigh; ++row)
    for (let column = 0; column < roomWide; ++column) {
      const light = brightness(column / roomWide, (row + 0.5) / roomHigh);
      [light, 0.99 * light, 0.97 * light, 1].forEach((value, i) => {
        data[4 * (row * roomWide + column) + i] = DataUtils.toHalfFloat(value);
      });
    }
  const room = new DataTexture(data, roomWide, roomHigh, RGBAFormat, HalfFloatType);
  room.mapping = EquirectangularReflectionMapping;
  room.minFilter = LinearFilter;
  room.magFilter = LinearFilter;
  room.needsUpdate = true;
  return room;
}

/** Around the room, and from the floor to the ceiling; both 0 to 1. */
function brightness(around: number, up: number): number {
  const walls = 0.12 + 0.68 * up ** 1.5;
  const lamps = Math.max(0, Math.cos(6 * Math.PI * around)) ** 6;
  const high = Math.exp(-(((up - 0.74) / 0.1) ** 2));
  const window = Math.exp(-(((up - 0.5) / 0.16) ** 2)) * Math.max(0, Math.cos(2 * Math.PI * (around - 0.3))) ** 24;
  return walls + 5.5 * lamps * high + 1.8 * window;
}

/** Draws nothing, and takes away what was drawn here as if it were as far as can be: it hides nothing drawn later. */
export const hidesNothing = (): ShaderMaterial =>
  new ShaderMaterial({
    vertexShader:
      'void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); gl_Position.z = gl_Position.w; }',
    fragmentShader: 'void main() { gl_FragColor = vec4(0.0); }',
    colorWrite: false,
    depthFunc: AlwaysDepth,
    transparent: true,
  });

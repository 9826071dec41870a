import { BufferGeometry, CanvasTexture, Group, Line, LineBasicMaterial, Sprite, SpriteMaterial, Vector3 } from 'three';

import type { Triple } from '../wire/messages';

const ink = '#10161a';
const paper = '#ffd84d';
/** Of the picture's height, whatever the distance. */
const markSize = 0.06;
const texturePx = 128;

/** Numbered marks at measured places and the line between two; seen through bone. In the frame of the places. */
export class MeasureMarks {
  readonly group = new Group();

  show(places: readonly Triple[]): void {
    this.clear();
    const points = places.map((place) => new Vector3(...place));
    if (points.length > 1) {
      const geometry = new BufferGeometry().setFromPoints(points);
      const line = new Line(geometry, new LineBasicMaterial({ color: ink, depthTest: false, toneMapped: false }));
      line.renderOrder = 3;
      this.group.add(line);
    }
    points.forEach((point, i) => {
      const map = numbered(String(i + 1));
      const sprite = new Sprite(
        new SpriteMaterial({ map, depthTest: false, sizeAttenuation: false, toneMapped: false }),
      );
      sprite.position.copy(point);
      sprite.scale.setScalar(markSize);
      sprite.renderOrder = 4;
      this.group.add(sprite);
    });
  }

  clear(): void {
    for (const part of [...this.group.children] as (Line | Sprite)[]) {
      this.group.remove(part);
      if (part instanceof Line) part.geometry.dispose();
      const material = part.material as SpriteMaterial | LineBasicMaterial;
      if ('map' in material) material.map?.dispose();
      material.dispose();
    }
  }
}

/** A ring around the place itself, which stays free, and its number beside it. */
function numbered(text: string): CanvasTexture {
  const canvas = document.createElement('canvas');
  canvas.width = texturePx;
  canvas.height = texturePx;
  const onto = canvas.getContext('2d');
  if (onto !== null) {
    drawRing(onto);
    drawNumber(onto, text);
  }
  return new CanvasTexture(canvas);
}

function drawRing(onto: CanvasRenderingContext2D): void {
  const middle = texturePx / 2;
  for (const [colour, width] of [
    [ink, 13],
    [paper, 7],
  ] as const) {
    onto.strokeStyle = colour;
    onto.lineWidth = width;
    onto.beginPath();
    onto.arc(middle, middle, 16, 0, Math.PI * 2);
    onto.stroke();
  }
}

function drawNumber(onto: CanvasRenderingContext2D, text: string): void {
  onto.font = 'bold 44px system-ui, sans-serif';
  onto.textAlign = 'center';
  onto.textBaseline = 'middle';
  onto.lineWidth = 10;
  onto.strokeStyle = ink;
  onto.strokeText(text, 98, 30);
  onto.fillStyle = paper;
  onto.fillText(text, 98, 30);
}

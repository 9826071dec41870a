import { CanvasTexture, Mesh, MeshBasicMaterial, PlaneGeometry } from 'three';

import type { HeadsetWords } from './headset';

const widthPx = 1024;
const heightPx = 96;
/** Metres from the eyes. */
const ahead = 0.9;
const below = 0.3;
const width = 0.6;

/** A line of words that stays in sight: below the middle, wherever the head turns. */
export class HeadsetSign {
  private readonly paper = document.createElement('canvas');
  private readonly texture = new CanvasTexture(this.paper);
  private readonly material = new MeshBasicMaterial({
    map: this.texture,
    transparent: true,
    depthTest: false,
    toneMapped: false,
  });
  readonly mesh = new Mesh(new PlaneGeometry(width, (width * heightPx) / widthPx), this.material);
  private said: HeadsetWords = { text: '', warns: false };

  constructor() {
    this.paper.width = widthPx;
    this.paper.height = heightPx;
    this.mesh.position.set(0, -below, -ahead);
    this.mesh.renderOrder = 1000;
    this.mesh.visible = false;
  }

  say(words: HeadsetWords): void {
    if (words.text === this.said.text && words.warns === this.said.warns) return;
    this.said = words;
    this.mesh.visible = words.text !== '';
    const ink = this.paper.getContext('2d');
    if (ink === null) return;
    ink.clearRect(0, 0, widthPx, heightPx);
    ink.fillStyle = words.warns ? '#8c1d18' : 'rgb(20 28 32 / 0.86)';
    ink.beginPath();
    ink.roundRect(0, 0, widthPx, heightPx, 24);
    ink.fill();
    ink.fillStyle = '#ffffff';
    ink.font = '600 46px system-ui, sans-serif';
    ink.textAlign = 'center';
    ink.textBaseline = 'middle';
    ink.fillText(words.text, widthPx / 2, heightPx / 2, widthPx - 40);
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.material.dispose();
    this.texture.dispose();
  }
}

import type { Triple } from '../wire/rest_types';
import type { SlicePlane } from './orientation';
import { numberOf, voxelAxes, type VolumeFrame } from './volume_frame';

/** Part of a plane that is looked at. */
export interface SliceLook {
  /** At the middle of the picture; its place along the plane's axis does not matter. */
  centre: Triple;
  pxPerMm: number;
}

export interface PicturePoint {
  x: number;
  y: number;
}

/** A box of the CT, voxels. */
export interface VoxelBox {
  low: Triple;
  high: Triple;
}

/** A box (the whole CT where none is given), as large as it fits the picture. */
export function fittingLook(
  frame: VolumeFrame,
  plane: SlicePlane,
  widthPx: number,
  heightPx: number,
  box: VoxelBox = { low: [0, 0, 0], high: frame.dims },
): SliceLook {
  const across = ({ axis }: SlicePlane['right']) => {
    const i = numberOf(axis);
    return Math.max(box.high[i] - box.low[i], 1) * frame.spacingMm[i];
  };
  const pxPerMm = Math.min(widthPx / across(plane.right), heightPx / across(plane.down));
  const middle = (i: 0 | 1 | 2) => (box.low[i] + box.high[i]) / 2;
  return { centre: [middle(0), middle(1), middle(2)], pxPerMm };
}

/** Where the places of one slice are in a picture of a size; pixels from its upper left corner. */
export class SliceLayout {
  constructor(
    private readonly frame: VolumeFrame,
    private readonly plane: SlicePlane,
    readonly look: SliceLook,
    private readonly widthPx: number,
    private readonly heightPx: number,
  ) {}

  toPicture(voxel: Triple): PicturePoint {
    const { right, down } = this.plane;
    return {
      x: this.widthPx / 2 + this.offset(voxel, right),
      y: this.heightPx / 2 + this.offset(voxel, down),
    };
  }

  pointToPicture(worldPoint: Triple): PicturePoint {
    return this.toPicture(this.frame.voxelFromWorld(worldPoint));
  }

  /** A place of the picture; along the plane's axis it is where `through` is. */
  toVoxel({ x, y }: PicturePoint, through: Triple): Triple {
    const voxel: Triple = [...through];
    voxel[numberOf(this.plane.right.axis)] = this.place(x - this.widthPx / 2, this.plane.right);
    voxel[numberOf(this.plane.down.axis)] = this.place(y - this.heightPx / 2, this.plane.down);
    return voxel;
  }

  /** How far a place lies off the slice that `through` is in, mm. */
  offSliceMm(voxel: Triple, through: Triple): number {
    const axis = numberOf(this.plane.axis);
    return Math.abs(voxel[axis] - through[axis]) * this.frame.spacingMm[axis];
  }

  /** Numbers for a canvas' transform that draws the slice's pixels, the first of its two voxel axes along rows. */
  transform(): [number, number, number, number, number, number] {
    const first = voxelAxes.find((axis) => axis !== this.plane.axis);
    const straight = this.plane.right.axis === first;
    const stepRight = this.pxPerVoxel(this.plane.right);
    const stepDown = this.pxPerVoxel(this.plane.down);
    const { x, y } = this.toPicture([0, 0, 0]);
    return straight ? [stepRight, 0, 0, stepDown, x, y] : [0, stepDown, stepRight, 0, x, y];
  }

  /** The look after the picture was moved by pixels. */
  movedBy(rightPx: number, downPx: number): SliceLook {
    const middle = { x: this.widthPx / 2 - rightPx, y: this.heightPx / 2 - downPx };
    return { ...this.look, centre: this.toVoxel(middle, this.look.centre) };
  }

  /** The look after the picture was enlarged around one of its places, which stays where it is. */
  zoomedAt(at: PicturePoint, factor: number): SliceLook {
    const pxPerMm = Math.min(Math.max(this.look.pxPerMm * factor, 0.2), 60);
    const kept = this.toVoxel(at, this.look.centre);
    const grown = new SliceLayout(this.frame, this.plane, { ...this.look, pxPerMm }, this.widthPx, this.heightPx);
    const now = grown.toPicture(kept);
    return grown.movedBy(at.x - now.x, at.y - now.y);
  }

  private pxPerVoxel({ axis, sign }: SlicePlane['right']): number {
    return sign * this.frame.spacingMm[numberOf(axis)] * this.look.pxPerMm;
  }
  private offset(voxel: Triple, side: SlicePlane['right']): number {
    const i = numberOf(side.axis);
    return (voxel[i] - this.look.centre[i]) * this.pxPerVoxel(side);
  }
  private place(offsetPx: number, side: SlicePlane['right']): number {
    return this.look.centre[numberOf(side.axis)] + offsetPx / this.pxPerVoxel(side);
  }
}

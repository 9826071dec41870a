/**
 * From a turn of this share of the way to the next blade between two pictures, blades begin to be a blur; they are one
 * at the other.
 */
const blurFromShare = 0.2;
const blurWholeShare = 0.4;
/** How fast pictures follow is known after some of them. */
const pictureShare = 0.25;
const usualPictureS = 1 / 60;

/**
 * How a reamer that turns is seen. What turns by nearly a blade between two pictures seems to stand or to turn back, so
 * that blades which turn so fast are seen as what they sweep.
 */
export class Spin {
  /** Around the feed axis, rad. */
  angle = 0;
  /** 0: blades are seen one by one, 1: only what they sweep. */
  blur = 0;
  private pictureS = usualPictureS;
  private turning = false;

  constructor(private readonly pitchRad: number) {}

  /** The next picture, so long after the last one. */
  turn(seconds: number, speedRadS: number): void {
    // What stood begins to turn with this picture.
    if (this.turning) {
      this.angle = (this.angle + speedRadS * seconds) % (2 * Math.PI);
      this.pictureS += (seconds - this.pictureS) * pictureShare;
    }
    this.turning = true;
    const share = (Math.abs(speedRadS) * this.pictureS) / this.pitchRad;
    this.blur = smooth((share - blurFromShare) / (blurWholeShare - blurFromShare));
  }

  /** It stands where it is. */
  stand(): void {
    this.turning = false;
    this.blur = 0;
    this.pictureS = usualPictureS;
  }
}

function smooth(share: number): number {
  const within = Math.min(Math.max(share, 0), 1);
  return within * within * (3 - 2 * within);
}

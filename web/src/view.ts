// One picture of the large view, and what is around it.
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Body } from './body';
import { ColourBar } from './colour_bar';
import { Drawing } from './on_screen';
import { Picture } from './picture';
import { Result } from './results';
import { Camera } from './stage';

/** A body as it is shown, and what belongs to it. */
export interface View {
  /** the body, and what of it is shown */
  whole: Body;
  result: Result;
  body: Body;
  picture: Picture;
  camera: Camera;
  controls: OrbitControls;
  bar: ColourBar;
  note: HTMLElement;
  readout: HTMLElement;
  drawing: Drawing;
  /** of a difference of two: said of it */
  less?: string;
}

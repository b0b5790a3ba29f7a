// The camera of the large view in the address: where it stands, what it looks at, how close.
import { keep, numbersIn, numbersText } from './address';
import type { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Camera } from './stage';

export function keepCamera(name: string, camera: Camera, controls: OrbitControls[], refresh: () => void) {
  const { three } = camera;
  const text = () => numbersText([...three.position.toArray(), ...controls[0].target.toArray(), three.zoom]);
  const home = text();
  keep(name, () => (text() === home ? undefined : text()), (given) => {
    const numbers = numbersIn(given, 7);
    if (!numbers || !(numbers[6] > 0)) return;
    three.position.fromArray(numbers);
    three.zoom = numbers[6];
    for (const one of controls) {
      one.target.fromArray(numbers, 3);
      one.update();
    }
    refresh();
  });
}

/** What can be done on the map, under it. */

import { Panel } from "../parts";

const WAYS: readonly (readonly [string, string])[] = [
  [
    "Drag",
    "either aircraft, the knob before it (its heading), the leader's turn, the slot (D), MIN, the wind",
  ],
  [
    "Keys",
    "Tab takes hold of each of these; arrow keys move it, with Shift a little; Ctrl-Z takes it back",
  ],
  ["Others", "Add aircraft or a cell; drag it, its heading or its edge; Delete removes it"],
  ["Map", "drag its ground, turn the wheel, or use two fingers; F brings all into sight"],
  [
    "Lines",
    "dashed: what is flown; fine dots: the ideal path; grey: slower, or too close; thin: equal times",
  ],
];

export function HowTo() {
  return (
    <Panel name="how" title="On the map">
      <dl>
        {WAYS.map(([name, what]) => (
          <>
            <dt key={name}>{name}</dt>
            <dd key={what}>{what}</dd>
          </>
        ))}
      </dl>
    </Panel>
  );
}

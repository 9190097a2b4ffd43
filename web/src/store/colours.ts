/** The colours of the instrument by what they mean: tokens.css says how they look. */

export type Colour =
  | "scale"
  | "ownship"
  | "plan"
  | "proposed"
  | "armed"
  | "selected"
  | "leader"
  | "leader-ring"
  | "managed"
  | "value"
  | "label"
  | "unit"
  | "caution"
  | "alert"
  | "superseded";

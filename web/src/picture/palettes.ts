/** The instrument's colours as values, for pictures that no style sheet goes with. */

import type { Colour } from "../store/colours";

export const PALETTES = ["dark", "light"] as const;
export type PaletteName = (typeof PALETTES)[number];
export type Palette = Readonly<Record<Colour | "glass" | "halo", string>>;

/** `dark` is the cockpit's, as tokens.css has it; `light` is for paper. Each text reads on its glass. */
export const COLOURS: Readonly<Record<PaletteName, Palette>> = {
  dark: {
    glass: "#040405",
    scale: "#e5dfd6",
    ownship: "#ffff00",
    plan: "#00ff00",
    proposed: "#ffff00",
    armed: "#17e9f2",
    selected: "#17e9f2",
    leader: "#e5dfd6",
    "leader-ring": "#17e9f2",
    managed: "#c87fda",
    value: "#00ff00",
    label: "#e5dfd6",
    unit: "#17e9f2",
    caution: "#eb880c",
    alert: "#ff3b30",
    superseded: "#8d8a85",
    halo: "#040405",
  },
  light: {
    glass: "#ffffff",
    scale: "#4a4d52",
    ownship: "#1b1d20",
    plan: "#0b7a2b",
    proposed: "#8a6a00",
    armed: "#006d7a",
    selected: "#006d7a",
    leader: "#26292d",
    "leader-ring": "#006d7a",
    managed: "#8a2fa6",
    value: "#0b6b28",
    label: "#33363b",
    unit: "#006d7a",
    caution: "#b04a00",
    alert: "#c4161c",
    superseded: "#75726d",
    halo: "#ffffff",
  },
};

/** The display units of aviation and how numbers are written: the only non-SI file of the cockpit. */

/** International nautical mile [m]. */
export const NM = 1852;
/** Knot [m/s]. */
export const KT = NM / 3600;
/** International foot [m]. */
export const FT = 0.3048;
/** Degree of arc [rad]. */
export const DEG = Math.PI / 180;

/** An angle brought into [0, 360) [deg]. */
export function wrap360(angle: number): number {
  return ((angle % 360) + 360) % 360;
}

/** An angle brought into [−180, 180) [deg]. */
export function wrap180(angle: number): number {
  return wrap360(angle + 180) - 180;
}

/** A heading as pilots write it: three digits, north is 360. `heading` [deg] */
export function formatHeading(heading: number): string {
  const whole = Math.round(wrap360(heading)) % 360;
  return String(whole === 0 ? 360 : whole).padStart(3, "0");
}

/** A speed in whole knots. `speed` [m/s] */
export function formatKnots(speed: number): string {
  return String(nearestInteger(speed / KT));
}

/** A speed in whole knots with its sign. `speed` [m/s] */
export function formatSignedKnots(speed: number): string {
  const knots = nearestInteger(speed / KT);
  return knots > 0 ? `+${knots}` : knots < 0 ? `−${-knots}` : "0";
}

/** A distance in nautical miles with `decimals` decimals. `distance` [m] */
export function formatMiles(distance: number, decimals = 1): string {
  return (distance / NM)
    .toFixed(decimals)
    .replace(/^-(?=0(\.0*)?$)/, "")
    .replace("-", "−");
}

/** A duration or a flight time, as everywhere on the page: mm:ss, from an hour on h:mm:ss. `time` [s] */
export function formatClock(time: number): string {
  const seconds = Math.round(Math.abs(time));
  const sign = time < 0 && seconds > 0 ? "−" : "";
  const hours = Math.floor(seconds / 3600);
  const [minutes, rest] = [Math.floor(seconds / 60) % 60, seconds % 60].map((each) =>
    String(each).padStart(2, "0"),
  );
  return `${sign}${hours > 0 ? `${hours}:` : ""}${minutes}:${rest}`;
}

/** A time typed as h:mm:ss, mm:ss or seconds [s]; null if it is none. */
export function readClockText(text: string): number | null {
  const parts = text.trim().split(":");
  if (parts.length > 3 || !parts.every((part) => /^\d+(\.\d+)?$/.test(part))) return null;
  return parts.reduce((sum, part) => 60 * sum + Number(part), 0);
}

/** A flight level, e.g. "FL350". `altitude` [m] */
export function formatLevel(altitude: number): string {
  return `FL${String(nearestInteger(altitude / FT / 100)).padStart(3, "0")}`;
}

/** The fields of commands as the page calls them. */
const NAMES = [
  ["tas_mps:", "The true airspeed"],
  ["heading_deg:", "The heading"],
] as const;

/** Shorter than this is said in metres: a twentieth of a mile. */
const SHORT = 0.05 * NM;

/** A sentence of the server, its fields by their names here, its speeds in knots and lengths in miles. */
export function inPageUnits(sentence: string): string {
  const named = NAMES.reduce((text, [field, name]) => text.replace(field, name), sentence);
  const number = "\\d+(?:\\.\\d+)?";
  const speeds = new RegExp(`(${number})( … )?(${number})? ?m/s(?![\\w²])`, "g");
  const fast = named.replace(
    speeds,
    (_, low: string, to: string | undefined, high: string | undefined) =>
      [
        formatKnots(Number(low)),
        ...(to && high ? [to, formatKnots(Number(high))] : []),
        " kt",
      ].join(""),
  );
  // "7,636 m (4.12 NM)" says it twice
  return fast
    .replace(/[\d,]+(?:\.\d+)? m \((\d+(?:\.\d+)? NM)\)/g, "$1")
    .replace(/(\d[\d,]*(?:\.\d+)?) m(?![\w/²])/g, (said, metres: string) => {
      const length = Number(metres.replaceAll(",", ""));
      return length < SHORT ? said : `${formatMiles(length, 2)} NM`;
    });
}

/** A bank as magnitude and side, e.g. "25 R". `bank` [deg], positive right wing down. */
export function formatBank(bank: number): string {
  const whole = nearestInteger(bank);
  return whole === 0 ? "0" : `${Math.abs(whole)} ${whole > 0 ? "R" : "L"}`;
}

/** Math.round without a negative zero. */
function nearestInteger(value: number): number {
  return Math.round(value) + 0;
}

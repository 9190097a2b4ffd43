/** Flights to compare, by how the address names them: `scenario:fig_6a`, `record:3f2a9c0d71be`. */

/** The two of the paper's conclusion. */
export const FIGURES = ["scenario:fig_6a", "scenario:fig_6b"] as const;

/** The flights that an address compares: two, or one that is seen beside the flight it shows. */
export function referencesIn(address: URLSearchParams): string[] {
  const text = address.get("compare") ?? "";
  return text.split(",").filter((each) => each !== "");
}

export function splitReference(reference: string): [kind: string, name: string] {
  const at = reference.indexOf(":");
  return at < 0 ? ["", reference] : [reference.slice(0, at), reference.slice(at + 1)];
}

import { describe, expect, test } from "vitest";
import { FIRST } from "../../src/map/first";
import { GALLERY } from "../../src/map/gallery";
import { clearAddress, readAddress, writeAddress } from "../../src/map/link";
import { type Situation, settle } from "../../src/map/situation";

const WINDY: Situation = {
  ...FIRST,
  leader: {
    ...FIRST.leader,
    intent: [
      { straight_s: 60.5 },
      { turn_to_heading_deg: 45.5, direction: "left", bank_deg: 22.5 },
    ],
  },
  wind: { from_deg: 310, speed_mps: 20.58 },
};

describe("the address", () => {
  test.each(GALLERY.map(({ name, situation }) => [name, settle(situation)] as const))(
    "holds all of %s",
    (_, situation) => {
      const address = new URL("http://there/?plan");
      writeAddress(address, situation);
      expect(readAddress(new URL(address.href).searchParams)).toEqual(situation);
    },
  );

  test("holds fractions, left turns and wind", () => {
    const address = new URL("http://there/?plan");
    writeAddress(address, WINDY);
    expect(readAddress(new URL(address.href).searchParams)).toEqual(WINDY);
    clearAddress(address);
    expect(address.href).toBe("http://there/?plan=");
  });

  test("without a situation is none, and no mistake", () => {
    expect(readAddress(new URL("http://there/?plan&engaged").searchParams)).toBeNull();
  });

  test.each([
    ["own=1 2 3", 'Own ship is "1 2 3", and 5 numbers are right.'],
    ["own=a b c d e", 'Own ship is "a b c d e", and 5 numbers are right.'],
    ["intent=60x", 'The intent has "60x", and pieces like 820s or 135R25 are right.'],
    ["intent=135R95", 'The intent has "135R95", and pieces like 820s or 135R25 are right.'],
    ["wind=270", 'The wind is "270", and 2 numbers are right.'],
    [
      "own=-9900000 0 90 240 25",
      "Own ship: east -9,900 km is refused, -1,000 to 1,000 km is right.",
    ],
    ["own=0 0 90 2572 25", "Own ship: airspeed 4,999.6 kt is refused, 59 to 777 kt is right."],
    ["distances=9000 12000", "D is 4.9 NM, and no less than MIN, 6.5 NM, is right."],
  ])("that is wrong says what was found and what is right: %s", (broken, sentence) => {
    const address = new URL("http://there/?plan");
    writeAddress(address, WINDY);
    const [name = "", value = ""] = broken.split("=");
    address.searchParams.set(name, value);
    expect(readAddress(address.searchParams)).toBe(sentence);
  });

  test("that lacks a part says which", () => {
    const address = new URL("http://there/?plan&own=0 0 90 240 25");
    expect(readAddress(address.searchParams)).toBe(
      "The leader is missing. The distances are missing.",
    );
  });
});

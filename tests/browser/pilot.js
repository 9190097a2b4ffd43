// A controller in place of the browser's own: `pilot.stick` moves it, or the roll bar while
// `pilot.follows`; it is unplugged while `pilot.unplugged`.
window.pilot = { stick: 0, follows: false, unplugged: false, bar: 0 };
{
  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(...how) {
      super(...how);
      this.addEventListener("message", ({ data }) => {
        const { documents = [] } = JSON.parse(data);
        const newest = documents.findLast(({ kind }) => kind === "sample");
        pilot.bar = newest?.guidance[0].bars?.[0]?.roll_deg ?? pilot.bar;
      });
    }
  };
  // Past the dead zone, and full at 10 degrees: on a busy machine what is seen is old by half a second.
  const deflection = () => Math.sign(pilot.bar) * Math.min(1, 0.08 + Math.abs(pilot.bar) / 10);
  navigator.getGamepads = () => [
    {
      id: "Scripted stick (Vendor: 0000)",
      connected: !pilot.unplugged,
      axes: [pilot.follows ? deflection() : pilot.stick, 0],
    },
  ];
}

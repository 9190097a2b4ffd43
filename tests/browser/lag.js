() => {
  const lags = { plans: [], areas: [] };
  window.lags = lags;
  const grips = document.querySelector(".grips");
  const changes = [];
  const asked = { plans: 0, areas: 0 };
  let input = 0;
  addEventListener("pointermove", (event) => { input = event.timeStamp; }, true);
  new MutationObserver(() => changes.push(input)).observe(grips, {
    subtree: true, attributes: true, attributeFilter: ["transform", "r"],
  });
  const painted = (then) =>
    requestAnimationFrame(() => {
      const channel = new MessageChannel();
      channel.port1.onmessage = () => then(performance.now());
      channel.port2.postMessage(0);
    });
  const send = window.fetch;
  window.fetch = async (...request) => {
    const kind = Object.keys(lags).find((each) => String(request[0]).includes(`/${each}`));
    if (kind === undefined || input === asked[kind]) return send(...request);
    // The oldest move that this question is the first to ask about.
    const waiting = changes.find((time) => time > asked[kind]);
    const oldest = waiting === undefined || waiting > input ? input : waiting;
    asked[kind] = input;
    const response = await send(...request);
    const read = response.text.bind(response);
    response.text = async () => {
      const text = await read();
      painted((time) => lags[kind].push(time - oldest));
      return text;
    };
    return response;
  };
}

/** Everything on the page that does not fit where it stands. */
() => {
  const found = [];
  const root = document.scrollingElement;
  if (root.scrollWidth > innerWidth) found.push(`page is ${root.scrollWidth} wide`);
  if (root.scrollHeight > innerHeight) found.push(`page is ${root.scrollHeight} high`);
  for (const element of document.querySelectorAll("body *")) {
    if (element.closest(".visually-hidden, svg, iframe, .nd-display") || !element.checkVisibility()) continue;
    const name = `${element.tagName.toLowerCase()}.${element.className} ${element.innerText ?? ""}`;
    const box = element.getBoundingClientRect();
    const style = getComputedStyle(element);
    const scrolls = element.closest(".log, .list, .panel-body") !== null;
    if (!scrolls && (box.right > innerWidth + 1 || box.bottom > innerHeight + 1
        || box.left < -1 || box.top < -1))
      found.push(`${name.slice(0, 60)} leaves the window`);
    if (element.scrollWidth > element.clientWidth + 1 && style.overflowX !== "visible"
        && style.textOverflow !== "ellipsis" && element.clientWidth > 0)
      found.push(`${name.slice(0, 60)} is ${element.scrollWidth - element.clientWidth} px too wide`);
    if (element.scrollHeight > element.clientHeight + 1 && style.overflowY === "hidden"
        && !(style.webkitLineClamp !== "none" && element.title === element.textContent)
        && element.clientHeight > 0)
      found.push(`${name.slice(0, 60)} loses ${element.scrollHeight - element.clientHeight} px below`);
  }
  return found;
}

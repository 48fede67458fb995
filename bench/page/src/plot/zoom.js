(() => {
  const NS = "http://www.w3.org/2000/svg";
  const LEFT = 92, RIGHT = 12, PLOT = 142, LINE = 18, BOTTOM = 24;
  const host = document.getElementById("panels");
  const make = (parent, name, attributes, text) => {
    const made = document.createElementNS(NS, name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    if (text !== undefined) made.textContent = text;
    parent.append(made);
    return made;
  };
  let low = Infinity, high = -Infinity;
  for (const panel of PANELS) for (const series of panel.series || []) for (const [x] of series.points) {
    if (x !== null && x < low) low = x;
    if (x !== null && x > high) high = x;
  }
  const all = [low, high];
  let view = [...all];
  let cursor = null;
  // Round steps of 1, 2 or 5 that give some five ticks.
  const ticks = ([from, to], count) => {
    const raw = (to - from) / count || 1, power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 5, 10].find((each) => each * power >= raw);
    const found = [];
    for (let tick = Math.ceil(from / step) * step; tick <= to + step * 1e-6; tick += step) found.push(Math.abs(tick) < step * 1e-6 ? 0 : tick);
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    return found.map((tick) => [tick, tick.toFixed(Math.min(digits, 9)).replace("-", "\u2212")]);
  };
  // First place at or after x in rising points.
  const first = (points, x) => {
    let from = 0, to = points.length;
    while (from < to) {
      const middle = (from + to) >> 1;
      if (points[middle][0] < x) from = middle + 1; else to = middle;
    }
    return from;
  };
  const seen = (series) => {
    if (series.mark === "band") return series.points;
    const from = first(series.points, view[0]), to = first(series.points, view[1]);
    return series.points.slice(Math.max(0, from - 1), to + 1);
  };
  const path = (points, x, y) => {
    let text = "", pen = "M";
    for (const [at, value] of points) {
      if (value === null) { pen = "M"; continue; }
      text += pen + x(at).toFixed(1) + " " + y(value).toFixed(1);
      pen = "L";
    }
    return text;
  };
  // Width of an entry of a legend, with room for a value: letters are some seven pixels wide.
  const START = 4;
  const entry = (series) => 7.6 * (series.name.length + (series.mark === "band" || series.mark === "dots" ? 0 : 11)) + 12;
  // Rows of a panel's legend.
  const rows = (panel, width) => {
    let count = 1, at = START;
    for (const series of panel.series) {
      const wide = 18 + entry(series);
      if (at + wide > width && at > START) { at = START; count += 1; }
      at += wide;
    }
    return count;
  };
  // Width for which the panels were drawn last.
  let drawn = 0;
  const draw = () => {
    const width = host.clientWidth;
    // A page that is not laid out yet, or is hidden, has no room: the observer below draws it when it has.
    if (width <= LEFT + RIGHT) return;
    drawn = width;
    const x = (at) => LEFT + (at - view[0]) / (view[1] - view[0]) * (width - LEFT - RIGHT);
    host.replaceChildren();
    PANELS.forEach((panel, index) => {
      const strip = panel.states !== undefined;
      const top = strip ? 0 : 24 + LINE * rows(panel, width);
      const height = strip ? panel.states.length * 22 + 14 : top + PLOT + BOTTOM;
      const svg = make(host, "svg", { height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": panel.y || "what holds when" });
      const clip = make(make(svg, "clipPath", { id: `clip-${index}` }), "rect", { x: LEFT, y: 0, width: width - LEFT - RIGHT, height });
      const body = document.createElementNS(NS, "g");
      body.setAttribute("clip-path", `url(#${clip.parentNode.id})`);
      if (strip) {
        svg.append(body);
        panel.states.forEach((name, at) => make(svg, "text", { x: 2, y: at * 22 + 20 }, name));
        for (const [state, from, to] of panel.stretches) {
          if (to >= view[0] && from <= view[1]) make(body, "rect", { x: x(from), y: state * 22 + 8, width: Math.max(1, x(to) - x(from)), height: 15, fill: `var(--series-${state % 7})` });
        }
      } else chart(svg, body, panel, x, width, top, height);
    });
  };
  const chart = (svg, body, panel, x, width, TOP, HEIGHT) => {
    let least = Infinity, most = -Infinity;
    for (const series of panel.series) for (const [at, value] of seen(series)) {
      if (value === null || at < view[0] || at > view[1]) continue;
      least = Math.min(least, value);
      most = Math.max(most, value);
    }
    if (least > most) [least, most] = [0, 1];
    const margin = (most - least || Math.abs(most) || 1) * 0.06;
    const range = [least - margin, most + margin];
    const y = (value) => HEIGHT - BOTTOM - (value - range[0]) / (range[1] - range[0]) * (HEIGHT - TOP - BOTTOM);
    make(svg, "text", { x: 2, y: 14, class: "title" }, panel.y);
    for (const [tick, text] of ticks(range, 5)) {
      make(svg, "line", { x1: LEFT, x2: width - RIGHT, y1: y(tick), y2: y(tick), class: "grid" });
      make(svg, "text", { x: LEFT - 6, y: y(tick) + 4, "text-anchor": "end" }, text);
    }
    const across = ticks(view, Math.max(2, Math.floor(width / 110)));
    for (const [tick, text] of across) {
      make(svg, "line", { x1: x(tick), x2: x(tick), y1: TOP, y2: HEIGHT - BOTTOM, class: "grid" });
      if (x(tick) < width - 90) make(svg, "text", { x: x(tick), y: HEIGHT - 8, "text-anchor": "middle" }, text);
    }
    make(svg, "text", { x: width - RIGHT, y: HEIGHT - 8, "text-anchor": "end" }, panel.x);
    svg.append(body);
    make(svg, "rect", { x: LEFT, y: TOP, width: width - LEFT - RIGHT, height: HEIGHT - TOP - BOTTOM, class: "frame" });
    let legend = START, row = 0;
    for (const series of panel.series) {
      const colour = `var(--series-${series.colour % 7})`;
      const points = seen(series);
      if (series.mark === "dots") for (const [at, value] of points) make(body, "circle", { cx: x(at), cy: y(value), r: 2, fill: colour });
      else if (series.mark === "band") make(body, "path", { d: path(points, x, y) + "Z", fill: colour, opacity: 0.3 });
      else make(body, "path", { d: path(points, x, y), fill: "none", stroke: colour, "stroke-width": 1.6, ...(series.mark === "dashed" && { "stroke-dasharray": "6 4" }) });
      let text = series.name;
      if (cursor !== null && series.mark !== "band" && series.mark !== "dots") {
        const near = series.points[Math.min(first(series.points, cursor), series.points.length - 1)];
        if (near && near[1] !== null) text = `${text} ${near[1].toPrecision(4).replace("-", "\u2212")}`;
      }
      if (!text) continue;
      const wide = 18 + entry(series);
      if (legend + wide > width && legend > START) { legend = START; row += 1; }
      const above = 18 + LINE * row;
      make(svg, "rect", { x: legend, y: above + 5, width: 14, height: 8, fill: colour, opacity: series.mark === "band" ? 0.4 : 1 });
      make(svg, "text", { x: legend + 18, y: above + 14 }, text);
      legend += wide;
    }
    if (cursor !== null) make(svg, "line", { x1: x(cursor), x2: x(cursor), y1: TOP, y2: HEIGHT - BOTTOM, class: "cursor" });
  };
  const place = (event) => {
    const box = host.getBoundingClientRect();
    const share = (event.clientX - box.left - LEFT) / (box.width - LEFT - RIGHT);
    return view[0] + Math.min(1, Math.max(0, share)) * (view[1] - view[0]);
  };
  const look = (from, to) => {
    const least = (all[1] - all[0]) * 1e-5;
    if (to - from < least) return;
    view = [Math.max(all[0], from), Math.min(all[1], to)];
    draw();
  };
  let start = null;
  const fingers = new Map();
  host.addEventListener("pointerdown", (event) => {
    fingers.set(event.pointerId, event);
    start = fingers.size === 1 ? place(event) : null;
  });
  host.addEventListener("pointermove", (event) => {
    if (fingers.size === 2 && fingers.has(event.pointerId)) {
      const [one, other] = [...fingers.values()];
      const before = Math.abs(one.clientX - other.clientX);
      fingers.set(event.pointerId, event);
      const [left, right] = [...fingers.values()];
      const after = Math.abs(left.clientX - right.clientX);
      if (before > 5 && after > 5) {
        const middle = place({ clientX: (left.clientX + right.clientX) / 2 });
        const ratio = before / after;
        look(middle - (middle - view[0]) * ratio, middle + (view[1] - middle) * ratio);
      }
      return;
    }
    cursor = place(event);
    draw();
    if (start === null) return;
    const [from, to] = [Math.min(start, cursor), Math.max(start, cursor)];
    const width = host.clientWidth;
    const x = (at) => LEFT + (at - view[0]) / (view[1] - view[0]) * (width - LEFT - RIGHT);
    for (const svg of host.children) make(svg, "rect", { x: x(from), y: 0, width: x(to) - x(from), height: svg.getAttribute("height"), class: "picked" });
  });
  const lift = (event) => {
    fingers.delete(event.pointerId);
    if (start !== null && event.type === "pointerup") {
      const end = place(event);
      if (Math.abs(end - start) > (view[1] - view[0]) * 0.01) look(Math.min(start, end), Math.max(start, end));
    }
    start = null;
  };
  host.addEventListener("pointerup", lift);
  host.addEventListener("pointercancel", lift);
  host.addEventListener("pointerleave", (event) => { fingers.delete(event.pointerId); start = null; cursor = null; draw(); });
  host.addEventListener("wheel", (event) => {
    event.preventDefault();
    const at = place(event), ratio = event.deltaY > 0 ? 1.25 : 0.8;
    look(at - (at - view[0]) * ratio, at + (view[1] - at) * ratio);
  }, { passive: false });
  const everything = () => { view = [...all]; draw(); };
  host.addEventListener("dblclick", everything);
  document.querySelector("button").addEventListener("click", everything);
  new ResizeObserver(() => { if (host.clientWidth !== drawn) draw(); }).observe(host);
  draw();
})();

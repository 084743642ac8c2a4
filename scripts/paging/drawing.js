// What drawings share: where the mouse is in one, a canvas as sharp as the screen.
"use strict";

/** Where an event is, in the units of the picture's view box, which stands in the middle of its element. */
function pointed(event, svg) {
  const box = svg.getBoundingClientRect(), { width, height } = svg.viewBox.baseVal, size = Math.min(box.width / width, box.height / height);
  return [(event.clientX - box.left - (box.width - width * size) / 2) / size, (event.clientY - box.top - (box.height - height * size) / 2) / size];
}

/** An empty canvas: its pen, its size, and the page's colours by name. */
function cleared(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue(name).trim();
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "11px system-ui";
  return { pen, width, height, colour };
}

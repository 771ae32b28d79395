// SPDX-License-Identifier: MIT
"use strict";

(async () => {
  const find = (id) => document.getElementById(id);
  const canvas = find("canvas");
  const status = find("status");
  const { width, height } = canvas;
  const pixels = width * height;
  const context = canvas.getContext("2d");
  const decoded = new Map();

  const inflate = async (text) => {
    const letters = atob(text);
    const bytes = new Uint8Array(letters.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = letters.charCodeAt(i);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };

  // The inverse of deflate_radiance(), include/mir/io/radiance_code.hpp: linear R, G, B by pixel.
  const decode = async (id) => {
    const planes = await inflate(find(id).textContent);
    const sums = new Uint16Array(pixels);
    const reds = new Uint8Array(pixels);
    const greens = new Uint8Array(pixels);
    const radiance = new Float32Array(3 * pixels);
    for (let y = 0, i = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x, ++i) {
        const expect = (codes) => {
          if (x === 0) return y > 0 ? codes[i - width] : 0;
          return y === 0 ? codes[i - 1] : (codes[i - 1] + codes[i - width]) >> 1;
        };
        const zigzag = planes[i] * 256 + planes[pixels + i];
        sums[i] = expect(sums) + (zigzag & 1 ? -(zigzag + 1) / 2 : zigzag / 2);
        reds[i] = expect(reds) + planes[2 * pixels + i];
        greens[i] = expect(greens) + planes[3 * pixels + i];
        if (sums[i] === 0) continue;
        const part = 2 ** ((sums[i] - 16384) / 64) / 255;
        radiance[3 * i] = part * reds[i];
        radiance[3 * i + 1] = part * greens[i];
        radiance[3 * i + 2] = part * Math.max(0, 255 - reds[i] - greens[i]);
      }
    }
    return radiance;
  };

  // Sum of layers, whose names are separated by blanks.
  const picture = async (names) => {
    if (!decoded.has(names)) {
      const ids = names.split(" ");
      let sum = ids.length === 1 ? await decode(ids[0]) : new Float32Array(3 * pixels);
      for (const id of ids.length === 1 ? [] : ids)
        (await picture(id)).forEach((value, i) => { sum[i] += value; });
      decoded.set(names, sum);
    }
    return decoded.get(names);
  };

  // Curves change the three channels of a colour in place, as mir/io/tone_curve.hpp does.
  const each = (curve) => (c) => {
    for (let i = 0; i < 3; ++i) c[i] = curve(c[i]);
  };
  const mixed = (m, c) => {
    const [r, g, b] = c;
    for (let i = 0; i < 3; ++i) c[i] = m[3 * i] * r + m[3 * i + 1] * g + m[3 * i + 2] * b;
  };
  const sigmoid = (value) => {
    const stops = Math.log2(Math.max(value, 1e-10));
    const x = Math.min(1, Math.max(0, (stops + 12.47393) / 16.499999));
    return (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
  };
  const curves = {
    none: () => {},
    reinhard: each((x) => x / (1 + x)),
    aces: each((x) => x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)),
    agx: (c) => {
      mixed([0.842479062253094, 0.0784335999999992, 0.0792237451477643,
             0.0423282422610123, 0.878468636469772, 0.0791661274605434,
             0.0423756549057051, 0.0784336, 0.879142973793104], c);
      each(sigmoid)(c);
      mixed([1.19687900512017, -0.0980208811401368, -0.0990297440797205,
             -0.0528968517574562, 1.15190312990417, -0.0989611768448433,
             -0.0529716355144438, -0.0980434501171241, 1.15107367264116], c);
      each((x) => Math.max(x, 0) ** 2.2)(c);
    },
  };
  const srgb = Uint8Array.from({ length: 4097 }, (_, i) => {
    const x = i / 4096;
    return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
  });

  const image = context.createImageData(width, height);
  const colour = new Float64Array(3);
  const paint = (radiance, begin, end) => {
    const scale = 2 ** Number(find("exposure").value);
    const curve = curves[find("curve").value];
    for (let y = 0; y < height; ++y) {
      for (let i = y * width + begin; i < y * width + end; ++i) {
        for (let c = 0; c < 3; ++c) colour[c] = scale * radiance[3 * i + c];
        curve(colour);
        for (let c = 0; c < 3; ++c)
          image.data[4 * i + c] = srgb[Math.round(4096 * Math.min(1, Math.max(0, colour[c])))];
        image.data[4 * i + 3] = 255;
      }
    }
  };

  const chosen = () => find("layer").selectedOptions[0];
  // What is seen left of `border` and right of it.
  let shown = null;
  let beside = null;
  let border = width;
  const draw = async () => {
    const still = chosen().dataset.image;
    const names = chosen().value;
    find("exposure-value").textContent = `${Number(find("exposure").value).toFixed(1)} EV`;
    let label = `${chosen().textContent} of the render`;
    if (still) {
      shown = null;
      context.drawImage(find(still), 0, 0, width, height);
    } else {
      shown = await picture(names);
      const split = find("split");
      border = split ? Math.round(width * Number(split.value) / 100) : width;
      paint(shown, 0, border);
      beside = border < width ? await picture("reference") : null;
      if (beside) paint(beside, border, width);
      context.putImageData(image, 0, 0);
      if (border > 0 && border < width) {
        context.fillStyle = "#fff";
        context.fillRect(border, 0, Math.max(1, width / 800), height);
      }
      if (split) {
        find("split-value").textContent = `${split.value} %`;
        label += `, left ${split.value} %; right of it the reference`;
      }
    }
    canvas.setAttribute("aria-label", label);
    if (find("readout").textContent) read();
  };

  let waiting = false;
  const redraw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(async () => {
      waiting = false;
      await draw();
    });
  };

  // Radiance under the pointer, or at the place that the arrow keys lead to.
  const place = { x: width >> 1, y: height >> 1 };
  const read = () => {
    const right = place.x >= border;
    const radiance = right ? beside : shown;
    if (!shown || !radiance) {
      find("readout").textContent = "";
      return;
    }
    const at = 3 * (place.y * width + place.x);
    const values = Array.from(radiance.subarray(at, at + 3), (value) => value.toPrecision(3));
    const shrink = Number(canvas.dataset.shrink);
    find("readout").textContent =
      `${right ? "Reference" : chosen().textContent} at pixel ${place.x * shrink}, ${place.y * shrink}: ` +
      `${values.join(", ")} W/(m² sr)`;
  };
  const move = (x, y) => {
    place.x = Math.min(width - 1, Math.max(0, x));
    place.y = Math.min(height - 1, Math.max(0, y));
    read();
  };
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    move(Math.floor((event.clientX - box.left) * width / box.width),
         Math.floor((event.clientY - box.top) * height / box.height));
  });
  canvas.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 10 : 1;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!way) return;
    event.preventDefault();
    move(place.x + step * way[0], place.y + step * way[1]);
  });

  for (const id of ["layer", "curve", "exposure", "split"]) find(id)?.addEventListener("input", redraw);
  const lights = find("vpls");
  const chooseLights = () => {
    const only = find("vpl-bounce").value;
    lights.classList.toggle("off", !find("vpl-show").checked);
    for (const group of lights.querySelectorAll("g"))
      group.classList.toggle("off", only !== "all" && group.id !== only);
  };
  if (lights)
    for (const id of ["vpl-show", "vpl-bounce"]) find(id).addEventListener("input", chooseLights);

  try {
    await draw();
    find("still").hidden = true;
    canvas.hidden = false;
    find("controls").hidden = false;
    status.textContent = "";
    canvas.dataset.ready = "true";
  } catch (failure) {
    status.textContent = `This browser cannot decode the layers (${failure.message}); the picture ` +
      "below stands still.";
  }
})();

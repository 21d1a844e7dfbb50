// The student's view: H.264 by WebCodecs, JPEG where there is none. The glass from close by is JPEG.
let decoder = null;
let waitsForKey = true;
let decoding = false;   // a JPEG
let later = null;       // the JPEG after it
let shownFrom = 0;      // counts changes of student or camera
let failures = 0;
let drawn = 0;
let drawnAt = null;     // ms of the page, of the last picture

async function chooseCodec() {
  page.codec = "jpeg";
  // Browsers give it to secure pages alone.
  if (!("VideoDecoder" in window)) return;
  try {
    const support = await VideoDecoder.isConfigSupported({ codec: "avc1.42E01F" });
    if (support.supported) page.codec = "h264";
  } catch { /* Then it is JPEG. */ }
}

function wantedPictures() {
  if (page.opened === null) return page.bare ? null : page.codec;
  if (page.hides) return null;
  return page.closeUp && page.is?.close_up ? "close-up" : page.codec;
}

function tellPictures() {
  const codec = wantedPictures();
  if (codec !== page.told && say({ say: "pictures", codec })) page.told = codec;
}

function forgetPicture() {
  if (decoder && decoder.state !== "closed") decoder.close();
  decoder = later = null;
  shownFrom += 1;
  waitsForKey = true;
  const canvas = $("picture");
  canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
  write($("stream"), "");
  drawnAt = null;
  showAge();
}

function draw(image, width, height) {
  if (page.hides) return;
  const canvas = $("picture");
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  canvas.getContext("2d").drawImage(image, 0, 0, width, height);
  drawn += 1;
  drawnAt = performance.now();
  showAge();
  canvas.dataset.drawn = drawn;
  write($("stream"), `${page.told === "h264" ? "H.264" : "JPEG"}, ${width} × ${height}`);
}

function receivePicture(buffer) {
  const head = new DataView(buffer);
  if (head.getUint8(0) === 3) return receiveCard(head);
  const isCloseUp = head.getUint8(0) === 4;
  // One of the other camera may be under way.
  if (page.hides || page.opened === null || isCloseUp !== (page.told === "close-up")) return;
  const picture = {
    isKey: head.getUint8(1) === 1,
    width: head.getUint16(4, true),
    height: head.getUint16(6, true),
    timestamp: Number(head.getBigUint64(8, true)),
    bytes: new Uint8Array(buffer, 16),
  };
  if (head.getUint8(0) === 1) receiveH264(picture); else receiveJpeg(picture);
}

async function receiveJpeg(picture) {
  later = picture;
  if (decoding) return;
  decoding = true;
  while (later) {
    const { bytes, width, height } = later;
    const from = shownFrom;
    later = null;
    try {
      const image = await createImageBitmap(new Blob([bytes], { type: "image/jpeg" }));
      if (from === shownFrom) draw(image, width, height);
      image.close();
    } catch { /* A broken one is left out. */ }
  }
  decoding = false;
}

// The codec's name has profile, constraints and level, as the sequence parameter set begins (ISO/IEC 14496-15, RFC 6381).
function codecOf(bytes) {
  for (let at = 0; at + 6 < bytes.length; at += 1) {
    if (bytes[at] === 0 && bytes[at + 1] === 0 && bytes[at + 2] === 1 && (bytes[at + 3] & 31) === 7) {
      const hex = (byte) => byte.toString(16).padStart(2, "0");
      return "avc1." + hex(bytes[at + 4]) + hex(bytes[at + 5]) + hex(bytes[at + 6]);
    }
  }
  return null;
}

function lose() {
  if (decoder && decoder.state !== "closed") decoder.close();
  decoder = null;
  waitsForKey = true;
  say({ say: "lost" });
}

function receiveH264(picture) {
  if (waitsForKey && !picture.isKey) return;
  // The browser is too slow: what waits is old.
  if (decoder && decoder.decodeQueueSize > 8) return lose();
  try {
    if (!decoder) {
      const codec = codecOf(picture.bytes);
      if (!codec) return lose();
      decoder = new VideoDecoder({
        output: (frame) => {
          draw(frame, frame.displayWidth, frame.displayHeight);
          frame.close();
          failures = 0;
        },
        error: cannotDecode,
      });
      decoder.configure({ codec, optimizeForLatency: true });
    }
    waitsForKey = false;
    decoder.decode(new EncodedVideoChunk({
      type: picture.isKey ? "key" : "delta",
      timestamp: picture.timestamp,
      data: picture.bytes,
    }));
  } catch {
    cannotDecode();
  }
}

function cannotDecode() {
  failures += 1;
  if (failures < 3) return lose();
  forgetPicture();
  page.codec = "jpeg";
  tellPictures();
}

// A picture that stands still looks like a student who does.
function showAge() {
  const age = drawnAt === null ? 0 : Math.floor((performance.now() - drawnAt) / 1000);
  write($("age"), drawnAt === null ? "" : age < 1 ? tr("live") : tr("age", { age }));
}
setInterval(showAge, 250);

$("zoom").onclick = () => {
  const zoomed = $("student").classList.toggle("zoomed");
  $("zoom").setAttribute("aria-pressed", zoomed);
};
$("picture").onclick = () => { if (!dragged) $("zoom").click(); };

function showCamera() {
  const offers = page.is?.close_up ?? false;
  $("close-up").hidden = !offers;
  $("close-up").setAttribute("aria-pressed", page.closeUp);
  $("picture").setAttribute("aria-label", tr(offers && page.closeUp ? "sees_close_up" : "sees"));
}
$("close-up").onclick = () => {
  page.closeUp = !page.closeUp;
  forgetPicture();
  zoomTo(1);
  showCamera();
  tellPictures();
};

function showHiding() {
  $("hide").setAttribute("aria-pressed", page.hides);
  $("picture").hidden = page.hides;
  $("hidden").hidden = !page.hides;
}
$("hide").onclick = () => {
  page.hides = !page.hides;
  sessionStorage.setItem("hides", page.hides ? "yes" : "no");
  forgetPicture();
  showHiding();
  tellPictures();
};

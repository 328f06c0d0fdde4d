// The sounds of the typewriter, the reader and the punch, made by Web Audio. They are off until the visitor turns them on.
"use strict";

const deskSound = (() => {
  /** @type {AudioContext | null} */
  let audio = null;
  /** Pitch in hertz and length in seconds of a stroke of each device. @type {Record<string, [number, number]>} */
  const STROKES = { type: [1900, 0.025], read: [420, 0.06], punch: [160, 0.09] };

  /** @param {boolean} on */
  function turn(on) {
    audio?.close();
    audio = on ? new AudioContext() : null;
  }

  /**
   * Sound a number of strokes of a device within some seconds.
   * @param {"type" | "read" | "punch"} device
   * @param {number} strokes
   * @param {number} seconds
   */
  function strike(device, strokes, seconds) {
    if (!audio) return;
    const [pitch, length] = STROKES[device];
    const count = Math.min(strokes, Math.ceil(seconds * 25), 60);
    const noise = audio.createBuffer(1, Math.ceil(audio.sampleRate * length), audio.sampleRate);
    const samples = noise.getChannelData(0);
    for (let n = 0; n < samples.length; n += 1) samples[n] = (Math.random() * 2 - 1) * (1 - n / samples.length) ** 3;
    for (let n = 0; n < count; n += 1) {
      const source = new AudioBufferSourceNode(audio, { buffer: noise });
      const filter = new BiquadFilterNode(audio, { type: "bandpass", frequency: pitch * (0.95 + Math.random() / 10), Q: 2 });
      source.connect(filter).connect(new GainNode(audio, { gain: 0.3 })).connect(audio.destination);
      source.start(audio.currentTime + (seconds * n) / count);
    }
  }

  return { turn, strike };
})();

// The service worker of the site: the emulator's page starts again without a network, and loads its large file only once.
"use strict";
const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
const NAME = "hull1620-machine";
const PARTS = /\/(console\.html|_static\/.*|console\/.*)$/;

worker.addEventListener("install", () => worker.skipWaiting());
worker.addEventListener("activate", (event) => event.waitUntil(worker.clients.claim()));
worker.addEventListener("fetch", (event) => {
  const { request } = event;
  const { origin, pathname } = new URL(request.url);
  if (request.method !== "GET" || origin !== location.origin || !PARTS.test(pathname)) return;
  event.respondWith(pathname.endsWith("/machine.gzip") ? large(event) : newest(event));
});

/** Load a file, and keep it instead of an older version. @param {FetchEvent} event @param {Cache} cache */
async function loaded(event, cache) {
  const { request } = event;
  const response = await fetch(request);
  const copy = response.clone();
  if (response.ok)
    event.waitUntil(cache.delete(request, { ignoreSearch: true }).then(() => cache.put(request, copy)));
  return response;
}

/** Return the file of the emulator from the cache; its address has its version. @param {FetchEvent} event */
async function large(event) {
  const cache = await caches.open(NAME);
  return (await cache.match(event.request)) ?? loaded(event, cache);
}

/** Return a part of the page from the server, or without a network the part that was loaded last. @param {FetchEvent} event */
async function newest(event) {
  const cache = await caches.open(NAME);
  try {
    return await loaded(event, cache);
  } catch (error) {
    const known = await cache.match(event.request, { ignoreSearch: true });
    if (known) return known;
    throw error;
  }
}

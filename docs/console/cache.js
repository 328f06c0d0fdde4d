// The service worker of this folder: it keeps the file of the emulator, whose address has its version.
"use strict";
const NAME = "hull1620-machine";
self.addEventListener("install", () => self.skipWaiting());
self.addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));
self.addEventListener("fetch", (event) => {
  if (!new URL(event.request.url).searchParams.has("v")) return;
  event.respondWith(
    (async () => {
      const cache = await caches.open(NAME);
      const kept = await cache.match(event.request);
      if (kept) return kept;
      const response = await fetch(event.request);
      if (response.ok) {
        for (const old of await cache.keys()) await cache.delete(old);
        event.waitUntil(cache.put(event.request, response.clone()));
      }
      return response;
    })(),
  );
});

"""The studies that come with hull1620, a module each: ``plan(samples, seed)``, ``report(plan, store)``, SAMPLES."""

"""Checks of statements of the thesis (K. J. Butler, 1963), by chapter.

- Chapter 1: ``chapter3_equations`` and ``chapter3_wording``.
- Chapter 2: ``chapter2``.
- Chapter 3: ``chapter3_equations`` (small sets and equations (3.1) to (3.5)), ``chapter3_steps`` (first points, inside
  points, new planes), ``chapter3_stages`` (the stages H_1, H_2, ...), ``chapter3_boundary`` (projection, boundary
  points, duplicate equations), ``chapter3_wording`` (the text compared with the listings).
- Chapter 4: ``proofs`` (theorems 4.3 to 4.7), ``existence`` (theorems 4.1, 4.2 and 4.8), ``chapter4_examples`` (worked
  examples), ``chapter4_theorems`` (all other statements).
- Chapters 3 and 4: ``identities`` (identities for all real coordinates).
- Chapter 5: ``chapter5`` and ``chapter7``.
- Chapter 6: ``chapter5``.
- Chapter 7: ``chapter7``, ``chapter7_errors`` (errors, rejected data, the tolerance e) and ``chapter5``.
"""

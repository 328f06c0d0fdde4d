C  FIBONACCI NUMBERS, IN FIXED POINT UP TO THE K-TH, IN FLOATING TO THE
C  N-TH, AND THE RATIO OF THE LAST TWO.  FIXED POINT KEEPS FOUR DIGITS.
      DIMENSION IFIB(50), F(99)
      READ 1, K, N
      IFIB(1) = 1
      IFIB(2) = 1
      F(1) = 1.
      F(2) = 1.
      DO 10 I = 3, K
   10 IFIB(I) = IFIB(I-1) + IFIB(I-2)
      DO 20 I = 3, N
   20 F(I) = F(I-1) + F(I-2)
      PUNCH 2, (IFIB(I), I = 1, K)
      PUNCH 3, K, (I, F(I), I = 5, N, 5)
      G = F(N)/F(N-1)
      PUNCH 4, G, G, G, G
      STOP
    1 FORMAT (2I3)
    2 FORMAT (5I6)
    3 FORMAT (/I3, 15H IN FIXED POINT/ 2(I4, E16.8))
    4 FORMAT (/5HRATIO, F11.7, E12.4, E13.7, E20.2)
      END

C     PRIMES BELOW 200 BY THE SIEVE, IN FIXED POINT
      DIMENSION L(199),M(60)
      DO 10 I=2,199
   10 L(I)=1
      N=0
      DO 40 I=2,199
      IF (L(I)) 40,40,20
   20 N=N+1
      M(N)=I
      IF (I*I-199) 25,25,40
   25 J=I*I
   30 L(J)=0
      J=J+I
      IF (J-199) 30,30,40
   40 CONTINUE
      PUNCH 1,N
      PUNCH 2,(M(I),I=1,N)
    1 FORMAT(I3,7H PRIMES)
    2 FORMAT(10I4)
      STOP
      END

C     AREA UNDER Y = X**2 + 1 FROM 0 TO 2 BY THE TRAPEZOID AND SIMPSONS RULES
      N=4
   10 H=2./4.
      X=0.
      T=0.
      S=0.
      DO 50 I=1,5
      Y=X**2+1.
      K=I-I/2*2
      IF (I-1) 20,30,20
   20 IF (I-5) 25,30,30
   25 T=T+2.*Y
      IF (K) 26,26,27
   26 S=S+4.*Y
      GO TO 40
   27 S=S+2.*Y
      GO TO 40
   30 T=T+Y
      S=S+Y
   40 PUNCH 1,X,Y
   50 X=X+H
      T=T*H/2.
      S=S*H/3.
      PUNCH 2,T,S
      PRINT 3,T
    1 FORMAT(2HX=,F5.2,4H  Y=,F6.3)
    2 FORMAT(/9HTRAPEZOID,E14.8,2X,7HSIMPSON,E14.8/)
    3 FORMAT(5HAREA=,F6.3)
      STOP
      END

C     CONVEX HULL-PROGRAM 1
      DIMENSION X(51),Y(51),Z(51),U(51),V(51),W(51),E(51)
      DIMENSION XA(4), XB(4), XC(4), XD(4)
  100 READ 1,N
      DO 101 I=1,N
  101 READ 21,X(I),Y(I),Z(I)
      NUMB1=1
      NUMB2=2
      ICOEF=1
      INN=0
      IHEAD=0
      IF(N-2)102,107,134
  102 PUNCH 3,N
      PRINT 4
      PUNCH 5
      PUNCH 6, X(N), Y(N), Z(N)
  103 PUNCH 7
      GO TO 100
  104 PRINT 8
      GO TO 100
  105 PUNCH 3,N
      I1=1
      I2=2
      PRINT 4
      PUNCH 9
      DO 106 I=1,N
  106 PUNCH 10, I, X(I), Y(I), Z(I)
  107 I1=1
      I2=2
  108 IF(X(I1)-X(I2))109,110,109
  109 KPERP=1
      GO TO 113
  110 IF(Y(I1)-Y(I2))111,112,111
  111 KPERP=2
      GO TO 113
  112 KPERP=3
      GO TO 114
  113 A1=Y(I2)-Y(I1)
      B1=X(I1)-X(I2)
      C1=(X(I2)-X(I1))*Y(I1)+(Y(I1)-Y(I2))*X(I1)
      GO TO (114,115,100), KPERP
  114 A2=Z(I2)-Z(I1)
      B2=X(I1)-X(I2)
      C2=(X(I2)-X(I1))*Z(I1)+(Z(I1)-Z(I2))*X(I1)
      GO TO (116,100,115), KPERP
  115 A3=Z(I2)-Z(I1)
      B3=Y(I1)-Y(I2)
      C3 = (Y(I2) - Y(I1)) *Z(I1) + (Z(I1) - Z(I2)) *Y(I1)
  116 ZERO=0.
      IF (N-2) 104, 219, 117
  117 IF (INN-1) 118, 100, 181
  118 IF (IHEAD-2) 119, 120, 120
  119 PUNCH 11
      PUNCH 12
      PUNCH 13
      PUNCH 14
      IHEAD=2
  120 GO TO (121,122,123), KPERP
  121 PUNCH 15, NUMB1, A1, B1, ZERO, C1
      PUNCH 15, NUMB2, A2, ZERO, B2, C2
      GO TO 124
  122 PUNCH 15, NUMB1, A1, B1, ZERO, C1
      PUNCH 15, NUMB2, ZERO, A3, B3, C3
      GO TO 124
  123 PUNCH 15, NUMB1, A2, ZERO, B2, C2
      PUNCH 15, NUMB2, ZERO, A3, B3, C3
  124 GO TO (126,132,133,103), ICOEF
  126 PUNCH 16
      DO 127 I=1,2
  127 PUNCH 17,I
      IF (INN-2) 128, 103, 128
  128 DO 129 I=3,4
  129 PUNCH 18,I
      DO 130 I=5,6
  130 PUNCH 19,I
      GO TO 103
  131 ICOEF=2
      INN=0
      NUMB1=1
      NUMB2=2
      GO TO 105
  132 I1=3
      ICOEF=3
      NUMB1=NUMB1+2
      NUMB2=NUMB2+2
      GO TO 108
  133 I2=1
      ICOEF=1
      NUMB1=NUMB1+2
      NUMB2=NUMB2+2
      GO TO 108
  134 A=X(1)
      B=Y(1)
      C=Z(1)
      D=X(1)
      EE=Y(1)
      F=Z(1)
      DO 146 I=1,N
      IF(A-X(I))135,135,136
  135 KL=I
      A=X(I)
  136 IF (B-Y(I)) 137, 137, 138
  137 LL=I
      B=Y(I)
  138 IF(C-Z(I))139,139,140
  139 ML=I
      C=Z(I)
  140 IF (X(I)-D) 141, 141, 142
  141 KS=I
      D=X(I)
  142 IF (Y(I)-EE) 143,143,144
  143 LS=I
      EE=Y(I)
  144 IF(Z(I)-F)145,145,146
  145 MS=I
      F=Z(I)
  146 CONTINUE
      IF(X(KL)-X(KS))147,151,147
  151 IF (Y(LL) -Y(LS)) 160, 152, 160
  147 I1=KL
      I2=KS
      KPERP=1
      GO TO 155
  160 I1=LL
      I2=LS
      KPERP=2
      GO TO 155
  152 I1=ML
      I2=MS
      KPERP=3
  155 K=I1
      J=1
  150 RA=X(K)
      RB=Y(K)
      RC=Z(K)
      X(K) = X(J)
      Y(K) = Y(J)
      Z(K)=Z(J)
      X(J) = RA
      Y(J) = RB
      Z(J)=RC
      IF(J-1)153,153,154
  153 J=2
      IF(I2-1)157,157,158
  157 K=I1
      GO TO 150
  158 K=I2
      GO TO 150
  154 INN=2
      LINE=0
      I1=1
      I2=2
      GO TO (113,113,114), KPERP
  181 GO TO (182,182,189), KPERP
  182 DO 183 I=1,N
  183 E(I) = A1*X(I) + B1*Y(I) + C1
  184 E1=E(1)
      DO 186 I=1,N
      IF (E1**2-E(I) **2) 185,185,186
  185 E1=E(I)
      K=I
  186 CONTINUE
      IVERT=2
      L=3
      IF(E1)225,187,225
  187 IF (LINE-1) 188,219,104
  188 LINE=1
      GO TO (189,191,191), KPERP
  189 DO 190 I=1,N
  190 E(I) = A2*X(I) + B2*Z(I) + C2
      GO TO 184
  191 DO 192 I=1,N
  192 E(I) = A3*Y(I) + B3*Z(I) + C3
      GO TO 184
  225 IF (N-3) 104, 131, 125
  125 DO 226 I = 1,N
      O1=((Y(2)-Y(I))*(Z(2)-Z(1))-(Z(2)-Z(I))*(Y(2)-Y(1)))**2
      O2=((Z(2)-Z(I))*(X(2)-X(1))-(X(2)-X(I))*(Z(2)-Z(1)))**2
      O3=((X(2)-X(I))*(Y(2)-Y(1))-(Y(2)-Y(I))*(X(2)-X(1)))**2
  226 E(I)=O1+O2+O3
      E1=E(1)
      DO 228 I=1,N
      IF(E1-E(I))227,227,228
  227 E1=E(I)
      K=I
  228 CONTINUE
  193 RA=X(K)
      RB=Y(K)
      RC=Z(K)
      X(K) = X(L)
      Y(K)=Y(L)
      Z(K)=Z(L)
      X(L)=RA
      Y(L) = RB
      Z(L)=RC
      GO TO (199,194), IVERT
  194 A=Y(1)*Z(2)+Y(2)*Z(3)+Z(1)*Y(3)-Y(3)*Z(2)-Y(1)*Z(3)-Y(2)*Z(1)
      B=X(3)*Z(2)+X(1)*Z(3)+X(2)*Z(1)-X(1)*Z(2)-X(2)*Z(3)-X(3)*Z(1)
      C=X(1)*Y(2)+X(2)*Y(3)+Y(1)*X(3)-Y(2)*X(3)-X(1)*Y(3)-X(2)*Y(1)
      DD=X(3)*Y(2)*Z(1)+Y(3)*Z(2)*X(1)+X(2)*Y(1)*Z(3)
      D=DD-X(1)*Y(2)*Z(3)-X(2)*Y(3)*Z(1)-Y(1)*Z(2)*X(3)
      CP=0.
      DO 195 I=1,N
      E(I) = A*X(I) + B*Y(I) + C*Z(I) + D
  195 CP=CP+E(I)*E(I)
      IF (CP) 104, 209, 196
  196 F=E(1)
      DO 198 I=1,N
      IF(F*F-E(I)*E(I))197,197,198
  197 F=E(I)
      K=I
  198 CONTINUE
      L=4
      IVERT=1
      GO TO 193
  199 PRINT 20
      C1=(X(1)+X(2)+X(3)+X(4))/4.
      C2=(Y(1)+Y(2)+Y(3)+Y(4))/4.
      C3=(Z(1)+Z(2)+Z(3)+Z(4))/4.
      II=1
      I=1
      L=1
      J=2
      K=3
      U(1)=1
      V(1) = 2
      W(1) = 3
  200 XA(L)=Y(I)*Z(J)+Y(J)*Z(K)+Z(I)*Y(K)-Y(K)*Z(J)-Y(I)*Z(K)-Y(J)*Z(I)
      XB(L)=X(K)*Z(J)+X(I)*Z(K)+X(J)*Z(I)-X(I)*Z(J)-X(J)*Z(K)-X(K)*Z(I)
      XC(L)=X(I)*Y(J)+X(J)*Y(K)+Y(I)*X(K)-Y(J)*X(K)-X(I)*Y(K)-X(J)*Y(I)
      DD=X(K)*Y(J)*Z(I)+Y(K)*Z(J)*X(I)+X(J)*Y(I)*Z(K)
      XD(L) = DD-X(I) *Y(J) *Z(K) -X(J) *Y(K) *Z(I) -Y(I) *Z(J) *X(K)
      GO TO (201,202,203,204),II
  201 K=4
      L=2
      II=2
      U(2)=1
      V(2) = 2
      W(2) = 4
      GO TO 200
  202 J=3
      L=3
      II=3
      U(3)=1
      V(3) = 3
      W(3) = 4
      GO TO 200
  203 I=2
      L=4
      II=4
      U(4) = 2
      V(4) = 3
      W(4) = 4
      GO TO 200
  204 DO 206 I=1,4
      E(I) = XA(I) *C1 + XB(I) *C2 + XC(I) *C3 + XD(I)
      IF(E(I))206,104,205
  205 XA(I) = XA(I) * (-1.)
      XB(I) = XB(I) * (-1.)
      XC(I) = XC(I) * (-1.)
      XD(I) = XD(I) * (-1.)
  206 CONTINUE
      PUNCH 21,C1,C2,C3
      DO 207 I=1,4
      IU=U(I)
      IV=V(I)
      IW=W(I)
  207 PUNCH 21, XA(I), XB(I), XC(I), XD(I), IU, IV, IW
      PUNCH 25,N
      DO 208 I=1,N
  208 PUNCH 21, X(I), Y(I), Z(I)
      GO TO 100
  209 PRINT 23
      PUNCH 21, A, B, C, D
      IF(A)211,210,211
  210 IF(B) 213, 215, 213
  211 DO 212 I=1,N
      U(I)=Y(I)
      V(I) = Z(I)
  212 W(I) = X(I)
      KPROJ=1
      GO TO 217
  213 DO 214 I=1,N
      U(I)=X(I)
      V(I) = Z(I)
  214 W(I) = Y(I)
      KPROJ=2
      GO TO 217
  215 DO 216 I=1,N
      U(I) = X(I)
      V(I) = Y(I)
  216 W(I) = Z(I)
      KPROJ=3
  217 PUNCH 25, N, KPROJ
      DO 218 I=1,N
  218 PUNCH 21,U(I),V(I),W(I)
      GO TO 100
  219 PUNCH 3,N
      PUNCH 26
      PRINT 4
      PUNCH 27
      DO 220 I=1,2
  220 PUNCH 10, I, X(I), Y(I), Z(I)
      ZERO=0.
      ICOEF=4
      NUMB1=1
      NUMB2=2
      PUNCH 28
      PUNCH 29
      PUNCH 13
      PUNCH 14
      GO TO 120
    1 FORMAT (I2)
    3 FORMAT (/11HCONVEX HULL/2HN=,I4/)
    4 FORMAT (11HCONVEX HULL)
    5 FORMAT (13X,1HX,15X,1HY,15X,1HZ/)
    6 FORMAT (7X,E14.8,2X,E14.8,2X,E14.8)
    7 FORMAT (/31HCONVEX HULL HAS BEEN DETERMINED///)
    8 FORMAT (16HERROR IN PROGRAM)
    9 FORMAT (/8HVERTICES//2X, 3HNO., 8X, 1HX, 15X, 1HY, 15X, 1HZ/)
   10 FORMAT (I3,4X,E14.8,2X,E14.8,2X,E14.8)
   11 FORMAT (//29HEQUATIONS OF SUPPORTING LINES, 16H ARE IN THE FORM)
   12 FORMAT (20HAX + BY + CZ + D = 0//)
   13 FORMAT (8HEQUATION, 5X, 1HA, 15X, 1HB, 15X, 1HC, 15X, 1HD)
   14 FORMAT (2X, 3HNO./)
   15 FORMAT (I3,2X,E14.8,2X,E14.8,2X,E14.8,2X,E14.8)
   16 FORMAT (//8HVERTICES, 13X, 16HSATISFY EQUATION/)
   17 FORMAT (2X,2H1,,2X,1H2,18X,I3)
   18 FORMAT (2X, 2H2, ,2X, 1H3, 18X, I3)
   19 FORMAT (2X, 2H1, ,2X, 1H3, 18X, I3)
   20 FORMAT (23HPOINTS ARE NOT COPLANAR)
   21 FORMAT (4E14.8,3I4)
   23 FORMAT (19HPOINTS ARE COPLANAR)
   25 FORMAT (I4,I2)
   26 FORMAT (/20HPOINTS ARE COLLINEAR/)
   27 FORMAT (/9HENDPOINTS//2X,3HNO.,8X,1HX,15X,1HY,15X,1HZ/)
28FORMAT (//21HEQUATIONS OF THE LINE, 30H CONTAINING THE GIVEN N POINTS)
   29 FORMAT (15HARE IN THE FORM, 21H AX + BY + CZ + D = 0//)
      END

C     CONVEX HULL-PROGRAM 3-NOT COPLANAR
      DIMENSION X(51), Y(51), Z(51), A(98), B(98), C(98), D(98), E(98)
      DIMENSION MM (98), NN (98), KK (98)
  100 KELEQ=1
C     INSID=2 IF INSIDE POINT HEADING HAS BEEN PUNCHED
      INSID=1
      NEWEQ=1
      NETC=1
      NE=4
      NV=4
      READ 1,C1,C2,C3
      DO 101 I=1,4
  101 READ 2,A(I),B(I),C(I),D(I),NN(I),MM(I),KK(I)
      READ 3,N
      PUNCH 4,N
      DO 102 I=1,N
  102 READ 1, X(I), Y(I), Z(I)
C     CHECKING FOR INSIDE POINTS
  103 IF (N-NV) 133, 161, 213
  213 I=NV+1
  104 DO 105 J=1,NE
  105 E(J) = A(J) *X(I) + B(J) *Y(I) + C(J) *Z(I) + D(J)
      EE=E(1)
      DO 107 K=1,NE
      IF (EE-E(K)) 106,106,107
  106 EE=E(K)
  107 CONTINUE
      IF (EE) 108,112,112
  108 GO TO (109,110), INSID
  109 PUNCH 5
      INSID=2
  110 PUNCH 6,X(I),Y(I),Z(I)
      N=N-1
      DO 111 L=I,N
      X(L)=X(L+1)
      Y(L)=Y(L+1)
  111 Z(L) = Z(L+1)
      IF (N+1-I) 133, 114, 104
  112 IF (N-I) 133, 114, 113
  113 I=I+1
      GO TO 104
C     CHECKING FOR SUPPORTING PLANES
  114 I123=1
      NINP=0
  115 IF (NE-NETC) 161,116,116
  116 J=NETC
      MR=MM(J)
      NR=NN(J)
      KR=KK(J)
      E(J) = A(J) *X(MR) + B(J) *Y(MR) + C(J) *Z(MR) + D(J)
      IF(E(J))119,117,119
  117 E(J) = A(J) *X(NR) + B(J) *Y(NR) + C(J) *Z(NR) + D(J)
      IF(E(J))119,118,119
  118 E(J) = A(J) *X(KR) + B(J) *Y(KR) + C(J) *Z(KR) + D(J)
      IF(E(J))119,120,119
  119 PRINT 7
      IF (SENSE SWITCH 1) 120,100
  120 DO 121 I=1,N
  121 E(I) = A(J) *X(I) + B(J) *Y(I) + C(J) *Z(I) + D(J)
      V=E(1)
      DO 123 I=1,N
      IF(V-E(I))122,122,123
  122 V=E(I)
      K=I
  123 CONTINUE
      IF(V)124,124,125
  124 NETC=NETC+1
      GO TO 115
  125 NV=NV+1
      XA=X(NV)
      YA=Y(NV)
      ZA=Z(NV)
      X(NV) = X(K)
      Y(NV) = Y(K)
      Z(NV) = Z(K)
      X(K) = XA
      Y(K) = YA
      Z(K) = ZA
  126 I1=MM(J)
      I2=NN(J)
      I3=KK(J)
      NE=NE+1
      GO TO (127,128,129,131),I123
  127 I1=NV
      GO TO 130
  128 I2=NV
      GO TO 130
  129 I3=NV
  130 MM (NE)=I1
      NN(NE) = I2
      KK(NE) = I3
      AA=Y(I1)*Z(I2)+Y(I2)*Z(I3)+Z(I1)*Y(I3)
      A(NE) = AA - Y(I3) *Z(I2) - Y(I1) *Z(I3) - Y(I2) *Z(I1)
      BB=X(I3)*Z(I2)+X(I1)*Z(I3)+X(I2)*Z(I1)
      B(NE) = BB - X(I1) *Z(I2) - X(I2) *Z(I3) - X(I3) *Z(I1)
      CC=X(I1)*Y(I2)+X(I2)*Y(I3)+Y(I1)*X(I3)
      C(NE) = CC - Y(I2) * X(I3) - X(I1) * Y(I3) - X(I2) * Y(I1)
      DD=X(I3)*Y(I2)*Z(I1)+Y(I3)*Z(I2)*X(I1)+X(I2)*Y(I1)*Z(I3)
      D(NE)=DD-X(I1)*Y(I2)*Z(I3)-X(I2)*Y(I3)*Z(I1)-Y(I1)*Z(I2)*X(I3)
      I123=I123+1
      GO TO 126
  131 NE=NE-1
      LJ=J
      KELEQ=3
      GO TO 157
  132 NEWEQ=J
      DO 135 I=NEWEQ, NE
      E(I) = A(I) *C1+B(I) *C2+C(I) *C3+D(I)
      IF(E(I))135,133,134
  133 PRINT 8
      GO TO 100
  134 A(I) = A(I) * (-1.)
      B(I)=B(I)*(-1.)
      C(I) = C(I) * (-1.)
      D(I) = D(I) * (-1.)
  135 CONTINUE
      DO 136 L=1,NE
  136 E(L) = A(L) *X(NV) + B(L) *Y(NV) + C(L) *Z(NV) + D(L)
      EE=E(1)
      DO 138 L=1,NE
      IF (EE-E(L)) 137, 137, 138
  137 EE=E(L)
      J=L
  138 CONTINUE
      IF (EE) 140, 140, 139
  139 I123=1
      NINP=NINP+1
      GO TO 126
  140 IF (NINP) 133, 103, 141
C     ELIMINATING INSIDE PLANES
  141 I=1
      KELEQ=1
  142 K=I+1
  143 KMN=MM(I)
      ID3=0
  144 IF (MM(K)-KMN) 145, 149, 145
  145 IF (NN(K)-KMN) 146, 149, 146
  146 IF (KK (K) -KMN) 147, 149, 147
  147 IF (NE-K) 133, 154, 148
  148 K=K+1
      GO TO 143
  149 ID3=ID3+1
      IF (KMN-MM(I)) 151, 150, 151
  150 KMN=NN(I)
      GO TO 144
  151 IF (KMN-NN(I)) 153, 152, 153
  152 KMN=KK(I)
      GO TO 144
  153 IF (ID3-3) 154, 156, 133
  154 IF (NE-I-1) 133, 103, 155
  155 I=I+1
      GO TO 142
  156 LJ=I
      IDO2=0
  157 NE=NE-1
      DO 158 LM=LJ,NE
      A(LM) = A(LM+1)
      B(LM)=B(LM+1)
      C(LM) = C(LM+1)
      D(LM) = D(LM+1)
      MM(LM) = MM(LM+1)
      NN(LM) = NN(LM+1)
  158 KK (LM) = KK (LM+1)
      GO TO (159,165,132), KELEQ
  159 IF (IDO2) 133, 160, 142
  160 IDO2=1
      LJ=K-1
      GO TO 157
C     DETERMINING BOUNDARY POINTS THAT ARE NOT VERTICES
  161 IBDRY=1
      IF (N-NV) 133, 164, 162
  162 IBDRY=2
      K=NV+1
      PUNCH 9
      DO 163 J=K,N
  163 PUNCH 10, X(J), Y(J), Z(J)
      N=NV
C     ELIMINATING MORE THAN ONE EQUATION OF THE SAME PLANE
  164 I=1
  165 MZ=MM(I)
      NZ=NN(I)
      KZ=KK(I)
      J=I+1
  166 EZ=A(J)*X(MZ)+B(J)*Y(MZ)+C(J)*Z(MZ)+D(J)
      IF (EZ) 170, 167, 170
  167 EZ = A(J) *X(NZ) + B(J) *Y(NZ) + C(J) *Z(NZ) + D(J)
      IF(EZ)170,168,170
  168 EZ=A(J)*X(KZ)+B(J)*Y(KZ)+C(J)*Z(KZ)+D(J)
      IF(EZ)170,169,170
  169 LJ=J
      KELEQ=2
      GO TO 157
  170 IF (NE-J) 133, 172, 171
  171 J=J+1
      GO TO 166
  172 IF (NE-I-1) 133, 174, 173
  173 I=I+1
      GO TO 165
  174 I=1
      DO 175 K=1,N
  175 E(K) = 0.
  176 IF(N-I)185,177,177
  177 IV=0
      DO 179 K=1,NE
      VERT=A(K)*X(I)+B(K)*Y(I)+C(K)*Z(I)+D(K)
      IF (VERT) 179, 178, 179
  178 IV=IV+1
  179 CONTINUE
      IF (IV-3) 182, 180, 180
  180 IF(N-I)133,185,181
  181 I=I+1
      GO TO 177
  182 IF (IBDRY-2) 183,184,133
  183 PUNCH 9
  184 PUNCH 10,X(I),Y(I),Z(I)
      E(I)=1.
      I=I+1
      GO TO 176
  185 PUNCH 11
      K=1
      DO 187 I = 1, N
      IF(E(I))133,186,187
  186 PUNCH 12,K,X(I),Y(I),Z(I)
      K=K+1
  187 CONTINUE
      PUNCH 13
      PUNCH 14
      PUNCH 15
      PUNCH 16
      DO 188 I=1,NE
  188 PUNCH 12, I, A(I), B(I), C(I), D(I)
      PUNCH 17
      I=1
  189 IF(E(I))133,192,190
  190 N=N-1
      DO 191 K=I,N
      E(K) = E(K+1)
      X(K)=X(K+1)
      Y(K)=Y(K+1)
  191 Z(K) = Z(K+1)
      IF(N-I)194,189,189
  192 IF (N-I) 194, 194, 193
  193 I=I+1
      GO TO 189
  194 K=1
  195 I=1
  196 DO 197 J=1,3
  197 MM(J) = 0
      NP=0
  198 E(I) = A(K) *X(I) + B(K) *Y(I) + C(K) *Z(I) + D(K)
      IF(E(I))199,201,199
  199 IF(N-I)133,205,200
  200 I=I+1
      GO TO 198
  201 NP=NP+1
      MM(NP) = I
      IF (NP-3) 202, 203, 133
  202 IF (N-I) 133, 206, 200
  203 PUNCH 19, MM(1), MM(2), MM(3), K
      IF (N-I) 133, 210, 204
  204 I=I+1
      GO TO 196
  205 IF(NP)133,210,206
  206 GO TO (207,208,209), NP
  207 PUNCH 20,MM(1),K
      GO TO 210
  208 PUNCH 21, MM(1), MM(2), K
      GO TO 210
  209 PUNCH 19,MM(1),MM(2),MM(3),K
  210 IF (NE-K) 133, 212, 211
  211 K=K+1
      GO TO 195
  212 PUNCH 18
      GO TO 100
    1 FORMAT (3E14.8)
    2 FORMAT (4E14.8,3I4)
    3 FORMAT (I4)
    4 FORMAT (/11HCONVEX HULL/2HN=,I4/)
    5 FORMAT (/13HINSIDE POINTS//13X,1HX,15X,1HY,15X,1HZ/)
    6 FORMAT (6X,E14.8,2X,E14.8,2X,E14.8)
    7 FORMAT (19HDATA NOT ACCEPTABLE)
    8 FORMAT (16HERROR IN PROGRAM)
    9 FORMAT (/15HBOUNDARY POINTS/13X,1HX,15X,1HY,15X,1HZ/)
   10 FORMAT (6X,E14.8,2X,E14.8,2X,E14.8)
   11 FORMAT (/8HVERTICES//2X,3HNO.,8X,1HX,15X,1HY,15X,1HZ/)
   12 FORMAT (I3,3X,E14.8,2X,E14.8,2X,E14.8,2X,E14.8)
   13 FORMAT (/30HEQUATIONS OF SUPPORTING PLANES, 16H ARE IN THE FORM)
   14 FORMAT (20HAX + BY + CZ + D = 0/)
   15 FORMAT (8HEQUATION, 5X, 1HA, 15X, 1HB, 15X, 1HC, 15X, 1HD)
   16 FORMAT (2X, 3HNO./)
   17 FORMAT (//3X,8HVERTICES,10X,16HSATISFY EQUATION/)
   18 FORMAT (//31HCONVEX HULL HAS BEEN DETERMINED///)
   19 FORMAT (I3,1H,,I3,1H,,I3,15X,I3)
   20 FORMAT (I3,23X,I3)
   21 FORMAT (I3,1H,,I3,19X,I3)
      END

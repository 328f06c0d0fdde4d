C     CONVEX HULL-PROGRAM 2-COPLANAR
      DIMENSION R(51), S(51), T(51), A(51), B(51), C(51), D(51), E(51)
      DIMENSION MM (51), NN (51)
  100 READ 1, AP, BP, CP, DP
      READ 2, N, KPROJ
      DO 101 I=1,N
  101 E(I) = 0.
      PUNCH 3,N
      DO 102 I=1,N
  102 READ 4,R(I),S(I),T(I)
      NETC=1
      NE=3
      NV=3
      NEWEQ=1
      INSID=1
      IBDRY=1
      C1=(R(1)+R(2)+R(3))/3.
      C2=(S(1)+S(2)+S(3))/3.
      A(1) = S(2) - S(1)
      B(1) = R(1) - R(2)
      C(1) = (R(2) - R(1)) *S(1) + (S(1) - S(2)) *R(1)
      MM(1)=1
      NN(1) = 2
      A(2) = S(3) - S(2)
      B(2)=R(2)-R(3)
      C(2) = (R(3) - R(2)) *S(2) + (S(2) - S(3)) *R(2)
      MM(2) = 3
      NN(2) = 2
      A(3) = S(1) - S(3)
      B(3) = R(3) - R(1)
      C(3) = (R(1) - R(3)) *S(1) + (S(3) - S(1)) *R(1)
      MM(3) = 1
      NN(3) = 3
  103 DO 105 J=NEWEQ, NE
      D(J) = A(J) *C1+B(J) *C2+C(J)
      IF(D(J))105,105,104
  104 A(J) = A(J) * (-1.)
      B(J) = B(J) * (-1.)
      C(J) = C(J) * (-1.)
  105 CONTINUE
      LESSQ=2
      IF (NE-3) 112, 106, 134
C     CHECKING FOR INSIDE POINTS
  106 IF (N-NV) 112, 136, 186
  186 I=NV+1
  107 DO 108 J=1,NE
  108 D(J) = A(J) * R(I) + B(J) * S(I) + C(J)
      DMAX=D(1)
      DO110 J=1, NE
      IF (DMAX-D(J))109,110,110
  109 DMAX=D(J)
  110 CONTINUE
      IF (DMAX) 111, 120, 120
  111 GO TO (113,114), INSID
  112 PRINT 5
      GO TO 100
  113 PUNCH 6
      INSID=2
  114 GO TO (115,116,117), KPROJ
  115 PUNCH 7, T(I), R(I), S(I)
      GO TO 118
  116 PUNCH 7, R(I), T(I), S(I)
      GO TO 118
  117 PUNCH 7, R(I), S(I), T(I)
  118 N=N-1
      DO 119 J=I,N
      R(J) = R(J+1)
      S(J)=S(J+1)
  119 T(J) = T(J+1)
      IF (N-I) 124, 107, 107
  120 IF(N-I)112,124,122
  122 I=I+1
      GO TO 107
C     CHECKING FOR SUPPORTING LINES
  124 I=NETC
      MR=MM(I)
      NR=NN(I)
      D(I) = A(I) *R(MR) + B(I) *S(MR) + C(I)
      IF(D(I))126,125,126
  125 D(I) = A(I) *R(NR) + B(I) *S(NR) + C(I)
      IF(D(I))126,128,126
  126 PRINT 8
      IF (SENSE SWITCH 1) 128,100
  128 NCK=NV+1
      IF (N-NCK) 144, 187, 187
  187 DO 129 J=NCK, N
  129 D(J) = A(I) * R(J) + B(I) * S(J) + C(I)
      DMAX=D(NCK)
      DO 131 J=NCK, N
      IF (DMAX-D(J))130,130,131
  130 DMAX=D(J)
      K=J
  131 CONTINUE
      IF (DMAX) 132, 132, 133
  132 NETC=NETC+1
      IF (NE-NETC) 136, 124, 124
  133 NV=NV+1
      RA=R(NV)
      SA=S(NV)
      TA=T(NV)
      R(NV) = R(K)
      S(NV) = S(K)
      T(NV) = T(K)
      R(K) = RA
      S(K)=SA
      T(K) = TA
      I1=MM(I)
      I2=NN(I)
      NE=NE+1
      A(NE) = S(I1) - S(NV)
      B(NE) = R(NV) - R(I1)
      C(NE) = (R(I1) - R(NV)) *S(NV) + (S(NV) - S(I1)) *R(NV)
      MM(NE) = MM(I)
      NN(NE) = NV
      NE=NE+1
      A(NE) = S(I2) - S(NV)
      B(NE) = R(NV) - R(I2)
      C(NE) = (R(I2) - R(NV)) *S(NV) + (S(NV) - S(I2)) *R(NV)
      MM(NE) = NN(I)
      NN(NE) = NV
      NEWEQ=NE-1
      GO TO 103
  134 NE=NE-1
      DO 135 J=I,NE
      A(J) = A(J+1)
      B(J) = B(J+1)
      C(J) = C(J+1)
      MM(J) = MM(J+1)
  135 NN(J) = NN(J+1)
      GO TO (166,106), LESSQ
C     CHECKING FOR BOUNDARY POINTS THAT ARE NOT VERTICES
  136 NPNCH=0
      IF (NV-N) 137, 144, 112
  137 PUNCH 9
      IBDRY=2
      K=NV+1
      DO 143 J=K,N
  138 GO TO (139,140,141), KPROJ
  139 PUNCH 7, T(J), R(J), S(J)
      GO TO 142
  140 PUNCH 7, R(J), T(J), S(J)
      GO TO 142
  141 PUNCH 7, R(J), S(J), T(J)
  142 IF (NPNCH) 112, 143, 160
  143 CONTINUE
      N=NV
C     CHECKING FOR BOUNDARY POINTS THAT WERE VERTICES
C     BUT ARE NOT VERTICES OF THE FINAL CONVEX HULL
  144 K=1
  145 DO 146 I=1,N
  146 D(I) = A(K) *R(I) + B(K) *S(I) + C(K)
      I=1
  147 IF(D(I))151,149,151
  149 IF (MM(K)-I) 150, 151, 150
  150 IF (NN(K)-I) 155, 151, 155
  151 IF(N-I)112,153,152
  152 I=I+1
      GO TO 147
  153 IF (NE-K) 112, 170, 154
  154 K=K+1
      GO TO 145
  155 I1=MM(K)
      I2=NN(K)
      I3=I
      KK=K
      AL=SQRT((R(I1)-R(I2))**2+(S(I1)-S(I2))**2)
      BL=SQRT((R(I1)-R(I3))**2+(S(I1)-S(I3))**2)
      CL=SQRT((R(I2)-R(I3))**2+(S(I2)-S(I3))**2)
      IF (AL+BL-CL) 157, 156, 157
  156 J=I1
      MM(K) = I3
      I1=MM(K)
      GO TO 158
  157 IF (AL+CL-BL) 1157, 2157, 1157
 1157 J=I3
      GO TO 158
 2157 J=I2
      NN(K)=I3
      I2=NN(K)
  158 NPNCH=2
      I=0
      IF (IBDRY-2) 159, 138, 112
  159 PUNCH 9
      GO TO 138
C     CHECKING FOR MORE THAN ONE EQUATION OF THE SAME LINE
  160 E(J)=1.
  161 I=I+1
  162 V1=A(I)*R(I1)+B(I)*S(I1)+C(I)
      IF(V1)169,163,169
  163 V2=A(I)*R(I2)+B(I)*S(I2)+C(I)
      IF(V2)169,164,169
  164 IF (I-KK) 165, 161, 165
  165 LESSQ=1
      GO TO 134
  166 IF (NE-I) 167, 162, 162
  167 IF (NE-KK) 112, 170, 168
  168 K=KK+1
      GO TO 145
  169 IF (NE-I) 112, 167, 161
  170 PUNCH 10
      NUMB=1
      DO 175 I=1,N
      IF (E(I)) 112,171,175
  171 GO TO (172,173,174), KPROJ
  172 PUNCH 11, NUMB, T(I), R(I), S(I)
      GO TO 190
  173 PUNCH 11, NUMB, R(I), T(I), S(I)
      GO TO 190
  174 PUNCH 11, NUMB, R(I), S(I), T(I)
  190 NUMB=NUMB+1
  175 CONTINUE
      PUNCH 12
      PUNCH 13
      PUNCH 14
      DO 179 I=1,NE
      ZERO=0.
      GO TO (176,177,178), KPROJ
  176 PUNCH 11, I, ZERO, A(I), B(I), C(I)
      GO TO 179
  177 PUNCH 11, I, A(I), ZERO, B(I), C(I)
      GO TO 179
  178 PUNCH 11, I, A(I), B(I), ZERO, C(I)
  179 CONTINUE
      PUNCH 15
      DO 191 I=1,N
      IF (E(I))112,184,180
  180 DO 184 K=1,NE
      IF (MM(K)-I) 182,181,181
  181 MM(K) = MM(K) - 1
  182 IF (NN(K)-I) 184,183,183
  183 NN(K) = NN(K) - 1
  184 CONTINUE
  191 CONTINUE
      DO 185 I=1,NE
  185 PUNCH 16, MM(I), NN(I), I
      PUNCH 17
      PUNCH 18
      PUNCH 19
      PUNCH 7, AP, BP, CP, DP
      PUNCH 20
      GO TO 100
    1 FORMAT (4E14.8)
    2 FORMAT (I4,I2)
    3 FORMAT (/11HCONVEX HULL/2HN=,I4/)
    4 FORMAT (3E14.8)
    5 FORMAT (16HERROR IN PROGRAM)
    6 FORMAT (/13HINSIDE POINTS//13X,1HX,15X,1HY,15X,1HZ/)
    7 FORMAT (6X,E14.8,2X,E14.8,2X,E14.8,2X,E14.8)
    8 FORMAT (19HDATA NOT ACCEPTABLE)
    9 FORMAT (/15HBOUNDARY POINTS//13X,1HX,15X,1HY,15X,1HZ/)
   10 FORMAT (/8HVERTICES//2X, 3HNO., 8X, 1HX, 15X, 1HY, 15X, 1HZ/)
   11 FORMAT (I4,2X,E14.8,2X,E14.8,2X,E14.8,2X,E14.8)
   12 FORMAT (/29HEQUATIONS OF SUPPORTING LINES, 16H ARE IN THE FORM)
   13 FORMAT (20HAX + BY + CZ + D = 0//)
   14 FORMAT (1X, 3HNO., 9X, 1HA, 15X, 1HB, 15X, 1HC, 15X, 1HD/)
   15 FORMAT (/1X,8HVERTICES,10X,16HSATISFY EQUATION/)
   16 FORMAT (I4,1H,,I4,14X,I4)
17FORMAT (//27HCOEFFICIENTS OF AN EQUATION, 24H OF THE PLANE CONTAINING)
18FORMAT (21HTHE GIVEN N POINTS IN, 30H THE FORM AX + BY + CZ + D = 0//)
   19 FORMAT (13X,1HA,15X,1HB,15X,1HC,15X,1HD/)
   20 FORMAT (/31HCONVEX HULL HAS BEEN DETERMINED)
      END

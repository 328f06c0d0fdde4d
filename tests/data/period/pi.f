c     pi = 16 atan(1/5) - 4 atan(1/239), each by its series
c     a card holds the size of the smallest term to be added
c     sense switch 2 on: every term is typed
      dimension q(2), w(2)
      q(1) = 5.
      q(2) = 239.
      w(1) = 16.
      w(2) = -4.
    5 read 90, e
      pi = 0.
      do 30 j = 1, 2
      x = 1./q(j)
      t = x
      s = 0.
      k = 1
   10 a = k
      d = t/a
      if (d**2 - e**2) 30, 20, 20
   20 s = s + d
      if (sense switch 2) 24, 26
   24 type 92, j, k, d, s
   26 t = -t*x*x
      k = k + 2
      go to 10
   30 pi = pi + w(j)*s
      punch 91, e, pi
      go to 5
   90 format (e10.1)
   91 format (14hterms down to ,e8.1, 5x, 4hpi =, f11.7)
   92 format (2i4, 2e16.8)
      end

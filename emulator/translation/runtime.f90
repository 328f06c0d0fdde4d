! The card reader, punch and typewriter of an IBM 1620, for a program that hull1620 translated to Fortran. CC0 1.0.
!
! usage: PROGRAM [-s SWITCHES] [-a FILE] [-d FILE] < cards > punched
!
! -s SWITCHES  turn on sense switches, for example -s 13
! -a FILE      take the lines that ACCEPT reads from FILE
! -d FILE      write a line to FILE for each decision (IF, computed GO TO, end of a DO): card, outcome and value
!
! PRINT and TYPE write to standard error. Every punched record has at most 72 columns and every typed line 87.
module ibm_1620
  use, intrinsic :: iso_fortran_env, only: error_unit, input_unit, int64, output_unit, real64
  implicit none
  private
  public :: read_cards, accept_lines, punch_cards, type_lines, real_64, int_64, undefined_integer, undefined_, zero_, start_, &
    finish_, pause_, sign_of_, integer_sign_of_, choice_of_, is_repeated_, switch_is_on_, four_digits_, quotient_, &
    fixed_of_, float_of_, at_, copied_, sqrt_of_, log_of_, sin_of_, cos_of_, atan_of_, exp_of_, power_of_, &
    integer_power_of_, begin_list_, end_list_, get_integer_, get_real_, put_integer_, put_real_
  integer, parameter :: real_64 = real64, int_64 = int64
  integer, parameter :: read_cards = 0, accept_lines = 1, punch_cards = 2, type_lines = 3, longest = 1000
  ! A number that no statement has defined: its sums and products are recognized too.
  integer(int64), parameter :: undefined_integer = 1000000000000000_int64
  character(len=*), parameter :: digit = '0123456789'
  real(real64), protected :: zero_ = 0
  character(len=80) :: program_name = 'program'
  integer :: decision_unit = 0, line_unit = 0, first_read = 0, cards_read = 0, tested_at = 0
  logical :: is_on(4) = .false., every_read_ends = .true., is_ahead = .false., is_at_end = .false.
  ! The input or output statement in progress: its FORMAT, the position in it, its record and its card of the program.
  integer :: device, place, column, columns_written, position, repeated_from
  character(len=:), allocatable :: layout
  character(len=longest) :: record, next_card

contains

  subroutine refuse_(card, text)
    integer, intent(in) :: card
    character(len=*), intent(in) :: text
    flush (output_unit)
    if (card > 0) then
      write (error_unit, '(a, a, i0, a, a)') trim(program_name), ': card ', card, ': ', text
    else
      write (error_unit, '(a, a, a)') trim(program_name), ': ', text
    end if
    stop 2, quiet=.true.
  end subroutine

  subroutine start_(name, every_read)
    character(len=*), intent(in) :: name
    logical, intent(in) :: every_read
    character(len=longest) :: option, text
    integer :: k, j, status
    program_name = name
    every_read_ends = every_read
    do k = 1, command_argument_count(), 2
      call get_command_argument(k, option)
      call get_command_argument(k + 1, text)
      status = 0
      select case (trim(option))
      case ('-a')
        open (newunit=line_unit, file=trim(text), status='old', action='read', iostat=status)
      case ('-d')
        open (newunit=decision_unit, file=trim(text), status='replace', action='write', iostat=status)
      case ('-s')
        do j = 1, len_trim(text)
          if (verify(text(j:j), '1234') > 0) call refuse_(0, 'sense switches are 1 to 4, found ' // trim(text))
          is_on(index('1234', text(j:j))) = .true.
        end do
      case default
        call refuse_(0, 'expected [-s SWITCHES] [-a FILE] [-d FILE], found ' // trim(option))
      end select
      if (status /= 0) call refuse_(0, 'cannot open ' // trim(text))
    end do
  end subroutine

  ! Decisions. Each function returns the branch that the program takes.

  subroutine record_decision_(card, outcome, value)
    integer, intent(in) :: card, outcome
    real(real64), intent(in) :: value
    if (decision_unit /= 0) write (decision_unit, '(i0, 1x, i0, 1x, es24.16e3)') card, outcome, value
  end subroutine

  integer function sign_of_(card, value) result(outcome)
    integer, intent(in) :: card
    real(real64), intent(in) :: value
    if (value /= value) call refuse_(card, 'the sign of an undefined number decides a branch')
    outcome = merge(1, 0, value > 0) - merge(1, 0, value < 0)
    if (decision_unit /= 0) call record_decision_(card, outcome, value)
  end function

  integer(int64) function defined_(card, value)
    integer, intent(in) :: card
    integer(int64), intent(in) :: value
    if (abs(value) > 100000000) call refuse_(card, 'an undefined integer is used')
    defined_ = value
  end function

  integer function integer_sign_of_(card, value) result(outcome)
    integer, intent(in) :: card
    integer(int64), intent(in) :: value
    outcome = int(sign(min(abs(defined_(card, value)), 1_int64), value))
    if (decision_unit /= 0) call record_decision_(card, outcome, real(value, real64))
  end function

  integer function choice_of_(card, value, labels)
    integer, intent(in) :: card, labels
    integer(int64), intent(in) :: value
    if (defined_(card, value) < 1 .or. value > labels) &
        call refuse_(card, 'the value ' // text_(value) // ' of a computed GO TO selects no statement number')
    choice_of_ = int(value)
    if (decision_unit /= 0) call record_decision_(card, choice_of_, real(value, real64))
  end function

  ! Step the variable of a DO, and return true if it does not exceed the limit.
  logical function is_repeated_(card, variable, step, last)
    integer, intent(in) :: card
    integer(int64), intent(inout) :: variable
    integer(int64), intent(in) :: step, last
    variable = mod(defined_(card, variable) + defined_(card, step), 10000_int64)
    is_repeated_ = variable <= defined_(card, last)
    if (decision_unit /= 0) call record_decision_(card, merge(1, 0, is_repeated_), real(variable, real64))
  end function

  logical function switch_is_on_(number)
    integer, intent(in) :: number
    if (number < 9) then
      switch_is_on_ = is_on(number)
    else
      ! Switch 9 is the indicator of the last card. Testing it turns it off.
      call look_ahead_()
      switch_is_on_ = is_at_end .and. cards_read > tested_at
      if (switch_is_on_) tested_at = cards_read
    end if
  end function

  ! Fixed-point numbers have four digits.

  integer(int64) function four_digits_(card, value)
    integer, intent(in) :: card
    integer(int64), intent(in) :: value
    four_digits_ = mod(defined_(card, value), 10000_int64)
  end function

  integer(int64) function quotient_(card, dividend, divisor)
    integer, intent(in) :: card
    integer(int64), intent(in) :: dividend, divisor
    quotient_ = 9999
    if (defined_(card, divisor) /= 0) quotient_ = defined_(card, dividend) / divisor
  end function

  integer(int64) function fixed_of_(card, value)
    integer, intent(in) :: card
    real(real64), intent(in) :: value
    if (.not. abs(value) <= huge(value)) call refuse_(card, 'no integer corresponds to an infinite or undefined number')
    fixed_of_ = int(mod(aint(value), 10000.0_real64), int64)
  end function

  real(real64) function float_of_(card, value)
    integer, intent(in) :: card
    integer(int64), intent(in) :: value
    float_of_ = real(defined_(card, value), real64)
  end function

  integer(int64) function at_(card, subscript, size)
    integer, intent(in) :: card, size
    integer(int64), intent(in) :: subscript
    if (subscript < 1 .or. subscript > size) &
      call refuse_(card, 'subscript ' // text_(subscript) // ' is outside an array of ' // text_(int(size, int64)) // &
                   ' elements')
    at_ = subscript
  end function

  ! A statement that only copies a field may copy element N+1 of an array, which is always undefined.
  integer(int64) function copied_(card, subscript, size)
    integer, intent(in) :: card, size
    integer(int64), intent(in) :: subscript
    copied_ = subscript
    if (subscript /= size + 1) copied_ = at_(card, subscript, size)
  end function

  real(real64) function undefined_()
    ! The bits of a quiet NaN. The module ieee_arithmetic would make every call save the state of the processor.
    undefined_ = transfer(9221120237041090560_int64, 1.0_real64)
  end function

  subroutine pause_(card, number)
    integer, intent(in) :: card, number
    write (error_unit, '(a, a, i0, a, i0, a)') trim(program_name), ': card ', card, ': PAUSE ', number, &
      ': the operator presses START'
  end subroutine

  subroutine finish_()
    stop 0, quiet=.true.
  end subroutine

  function text_(value)
    integer(int64), intent(in) :: value
    character(len=20) :: buffer
    character(len=:), allocatable :: text_
    write (buffer, '(i0)') value
    text_ = trim(buffer)
  end function

  ! Return the integer in a text. This is faster than an internal READ.
  integer function number_(text)
    character(len=*), intent(in) :: text
    integer :: k
    number_ = 0
    do k = 1, len(text)
      if (scan(text(k:k), '+-') == 0) number_ = 10 * number_ + iachar(text(k:k)) - iachar('0')
    end do
    if (text(1:1) == '-') number_ = -number_
  end function

  ! Floating-point functions of the 1620's library, which accept a negative argument.

  real(real64) function sqrt_of_(x)
    real(real64), intent(in) :: x
    sqrt_of_ = sqrt(abs(x))
  end function

  real(real64) function log_of_(x)
    real(real64), intent(in) :: x
    log_of_ = log(abs(x))
  end function

  real(real64) function sin_of_(x)
    real(real64), intent(in) :: x
    sin_of_ = sin(x)
  end function

  real(real64) function cos_of_(x)
    real(real64), intent(in) :: x
    cos_of_ = cos(x)
  end function

  real(real64) function atan_of_(x)
    real(real64), intent(in) :: x
    atan_of_ = atan(x)
  end function

  real(real64) function exp_of_(x)
    real(real64), intent(in) :: x
    exp_of_ = exp(x)
  end function

  real(real64) function power_of_(base, exponent)
    real(real64), intent(in) :: base, exponent
    power_of_ = abs(base)**exponent
  end function

  real(real64) function integer_power_of_(base, count)
    real(real64), intent(in) :: base
    integer(int64), intent(in) :: count
    integer_power_of_ = abs(base)**real(count, real64)
    if (base < 0 .and. mod(count, 2_int64) /= 0) integer_power_of_ = -integer_power_of_
  end function

  ! Records.

  subroutine look_ahead_()
    integer :: status
    if (is_ahead .or. is_at_end) return
    read (input_unit, '(a)', iostat=status) next_card
    is_at_end = status /= 0
    is_ahead = .not. is_at_end
  end subroutine

  subroutine end_record_()
    integer :: status, length
    select case (device)
    case (read_cards)
      call look_ahead_()
      if (is_at_end) call refuse_(place, 'the deck ended in the middle of a data set')
      record = next_card(:80)
      is_ahead = .false.
      cards_read = cards_read + 1
    case (accept_lines)
      if (line_unit == 0) call refuse_(place, 'ACCEPT needs a file of typed lines (-a FILE)')
      read (line_unit, '(a80)', iostat=status) record
      if (status /= 0) call refuse_(place, 'the typed lines ended in the middle of a data set')
    case (punch_cards)
      write (output_unit, '(a)') record(:len_trim(record(:min(columns_written, 72))))
      columns_written = 0
    case (type_lines)
      length = min(columns_written, 87)
      if (scan(record(:length), '|?') > 0) length = scan(record(:length), '|?') - 1
      write (error_unit, '(a)') record(:len_trim(record(:length)))
      columns_written = 0
    end select
    if (device > accept_lines) return
    if (scan(record, achar(13)) > 0) record(scan(record, achar(13)):) = ' '
    column = 0
  end subroutine

  subroutine write_columns_(columns)
    character(len=*), intent(in) :: columns
    if (columns_written + len(columns) > longest) call refuse_(place, 'a record of more than 1000 columns')
    record(columns_written + 1:columns_written + len(columns)) = columns
    columns_written = columns_written + len(columns)
  end subroutine

  subroutine begin_list_(card, unit, format, again)
    integer, intent(in) :: card, unit, again
    character(len=*), intent(in) :: format
    logical :: begins
    device = unit
    place = card
    layout = format
    position = 1
    repeated_from = again
    columns_written = 0
    if (unit == read_cards) then
      ! An empty hopper ends the run at the READ that begins a data set, which is the first one executed.
      begins = first_read == 0 .or. first_read == card .or. every_read_ends
      if (first_read == 0) first_read = card
      call look_ahead_()
      if (is_at_end .and. cards_read > 0 .and. begins) stop 0, quiet=.true.
      if (is_at_end .and. cards_read == 0) call refuse_(card, 'the hopper is empty at the first READ')
    end if
    if (unit <= accept_lines) call end_record_()
  end subroutine

  ! Process literals and slashes of the FORMAT up to the next field, and return false at its end.
  logical function reaches_field_()
    integer :: width, letter, k
    do
      reaches_field_ = position <= len(layout)
      if (.not. reaches_field_) return
      letter = position + verify(layout(position:) // ' ', digit) - 1
      if (scan(layout(position:position), ',/') > 0) then
        if (layout(position:position) == '/') call end_record_()
        position = position + 1
        cycle
      end if
      if (letter == position) return
      width = number_(layout(position:letter - 1))
      position = letter + 1
      do k = 1, width
        if (device <= accept_lines) then
          ! The columns of the card become the new text of an H field.
          column = column + 1
          if (layout(letter:letter) == 'H') layout(letter + k:letter + k) = record(min(column, 81):min(column, 81))
        else
          call write_columns_(merge(layout(letter + k:letter + k), ' ', layout(letter:letter) == 'H'))
        end if
      end do
      if (layout(letter:letter) == 'H') position = position + width
    end do
  end function

  ! End a list. The FORMAT keeps the texts that a READ stored in it.
  subroutine end_list_(format)
    character(len=*), intent(inout) :: format
    logical :: has_field
    has_field = reaches_field_()
    if (device >= punch_cards) call end_record_()
    if (device <= accept_lines) format = layout
  end subroutine

  subroutine next_field_(is_fixed, letter, width, decimals)
    logical, intent(in) :: is_fixed
    character, intent(out) :: letter
    integer, intent(out) :: width, decimals
    integer :: length, point
    logical :: is_reached
    if (.not. reaches_field_()) then
      if (repeated_from < 0) call refuse_(place, 'the FORMAT has no field for the numbers in the list')
      call end_record_()
      position = repeated_from + 1
      is_reached = reaches_field_()
    end if
    letter = layout(position:position)
    length = verify(layout(position + 1:) // ' ', digit // '.') - 1
    point = index(layout(position + 1:position + length), '.')
    decimals = 0
    if (point > 0) decimals = number_(layout(position + 1 + point:position + length))
    if (point == 0) point = length + 1
    width = number_(layout(position + 1:position + point - 1))
    position = position + length + 1
    if ((letter == 'I') .neqv. is_fixed) &
      call refuse_(place, 'the field ' // letter // ' does not have the mode of its number')
  end subroutine

  ! Return the number in a field from its left end on, with its blanks resolved.
  function squeezed_(field) result(text)
    character(len=*), intent(in) :: field
    character(len=:), allocatable :: text
    integer :: first, last, point, first_e, last_e, k
    logical :: drop
    text = ''
    first = verify(field, ' ')
    if (first == 0) return
    last = len_trim(field)
    point = index(field(first:last) // '.', '.') + first - 1
    first_e = len(field) + 1
    last_e = 0
    do k = first, last
      if (field(k:k) == 'E' .or. (k > first .and. scan(field(k:k), '+-') > 0)) then
        last_e = k
        first_e = min(first_e, k)
      end if
    end do
    drop = .false.
    if (point <= last .or. last_e > 0) then
      ! A blank after the first exponent mark, or between the point and the last one, may belong to the exponent.
      do k = first, last
        drop = drop .or. (field(k:k) == ' ' .and. (k > first_e .or. (point < k .and. k < last_e)))
      end do
    else
      last = len(field)
    end if
    do k = first, last
      if (field(k:k) /= ' ') then
        text = text // field(k:k)
      else if (.not. drop) then
        text = text // '0'
      end if
    end do
  end function

  subroutine get_field_(is_fixed, field, decimals)
    logical, intent(in) :: is_fixed
    character(len=:), allocatable, intent(out) :: field
    integer, intent(out) :: decimals
    character :: letter
    integer :: width
    call next_field_(is_fixed, letter, width, decimals)
    if (column < 80) field = squeezed_(record(column + 1:min(column + width, 80)) // repeat(' ', max(column + width - 80, 0)))
    if (column >= 80) field = ''
    column = column + width
  end subroutine

  subroutine no_number_(field)
    character(len=*), intent(in) :: field
    call refuse_(place, 'card or line ' // text_(int(cards_read, int64)) // ' of the data: ''' // field // &
                 ''' is not a number in range')
  end subroutine

  subroutine get_integer_(target)
    integer(int64), intent(out) :: target
    character(len=:), allocatable :: field
    integer :: decimals, k, first
    call get_field_(.true., field, decimals)
    target = 0
    if (len(field) == 0) return
    first = merge(2, 1, scan(field(1:1), '+-') > 0)
    if (first > len(field) .or. verify(field(first:), digit) > 0) call no_number_(field)
    do k = first, len(field)
      target = mod(10 * target + index(digit, field(k:k)) - 1, 10000_int64)
    end do
    if (field(1:1) == '-') target = -target
  end subroutine

  subroutine get_real_(target)
    real(real64), intent(out) :: target
    character(len=:), allocatable :: field, digits, exponent
    integer :: decimals, scale, lead, power, k
    call get_field_(.false., field, decimals)
    target = 0
    if (len(field) == 0) return
    k = merge(2, 1, scan(field(1:1), '+-') > 0)
    digits = ''
    scale = -1
    do while (k <= len(field))
      if (field(k:k) == '.' .and. scale < 0) then
        scale = 0
      else if (index(digit, field(k:k)) > 0) then
        digits = digits // field(k:k)
        if (scale >= 0) scale = scale + 1
      else
        exit
      end if
      k = k + 1
    end do
    if (digits == '') call no_number_(field)
    ! A point on the card overrides the decimals of the FORMAT. The exponent may omit its E if it has a sign.
    if (scale < 0) scale = decimals
    power = 0
    if (k <= len(field)) then
      exponent = field(k + merge(1, 0, field(k:k) == 'E'):)
      if (field(k:k) /= 'E' .and. scan(field(k:k), '+-') == 0) call no_number_(field)
      k = merge(2, 1, scan(exponent // ' ', '+-') == 1)
      if (k > len(exponent) .or. verify(exponent(k:), digit) > 0) call no_number_(field)
      if (len(exponent) > 9) call no_number_(field)
      power = number_(exponent)
    end if
    lead = verify(digits, '0')
    if (lead > 0) then
      lead = len(digits) - lead + 1
      if (abs(lead - scale + power) > 99) call no_number_(field)
      digits = digits // 'E' // text_(int(power - scale, int64))
      read (digits, *) target
    end if
    if (field(1:1) == '-') target = -target
  end subroutine

  ! Return the decimal digits of a number, those of the shortest decimal that reads back as the same number, without
  ! rounding, and the exponent of a point before the first digit.
  subroutine digits_of_(value, count, digits, exponent)
    real(real64), intent(in) :: value
    integer, intent(in) :: count
    character(len=100), intent(out) :: digits
    integer, intent(out) :: exponent
    character(len=26) :: text
    character(len=12) :: form
    real(real64) :: number
    integer :: precision
    write (text, '(es24.16e3)') value
    text = adjustl(text)
    if (count > 14 .or. verify(text(min(count + 2, 16):16), '9') == 0) then
      do precision = 0, 16
        write (form, '(a, i0, a)') '(es24.', precision, 'e3)'
        write (text, form) value
        text = adjustl(text)
        read (text, *) number
        if (number == value) exit
      end do
    end if
    precision = index(text, 'E')
    digits = text(1:1) // text(3:precision - 1) // repeat('0', 100)
    exponent = number_(trim(text(precision + 1:)))
    exponent = merge(0, exponent + 1, value == 0)
  end subroutine

  logical function e_field_(text, width, decimals, value) result(fits)
    character(len=*), intent(inout) :: text
    integer, intent(in) :: width, decimals
    real(real64), intent(in) :: value
    character(len=100) :: digits
    integer :: count, left, exponent, first
    count = merge(8, width - 6, width >= 14)
    left = count - decimals
    fits = count >= 1 .and. left >= 0
    if (.not. fits) return
    call digits_of_(abs(value), count, digits, exponent)
    exponent = merge(-99, exponent - left, value == 0)
    fits = abs(exponent) <= 99
    if (.not. fits) return
    first = width - count - 5
    text = repeat(' ', first) // digits(:left) // '.' // digits(left + 1:count) // 'E'
    if (is_negative_(value)) text(first:first) = '-'
    write (text(width - 2:width), '(a, i2.2)') merge('-', '+', exponent < 0), abs(exponent)
  end function

  logical function f_field_(text, width, decimals, value) result(fits)
    character(len=*), intent(inout) :: text
    integer, intent(in) :: width, decimals
    real(real64), intent(in) :: value
    character(len=100) :: digits
    integer :: exponent, left, point, k, power
    call digits_of_(abs(value), 100, digits, exponent)
    left = max(exponent, 0)
    ! One column is reserved for the sign.
    fits = left + decimals + 2 <= width
    if (.not. fits) return
    point = width - decimals
    text = repeat(' ', point - left - 1) // repeat('0', left) // '.' // repeat('0', decimals)
    if (is_negative_(value)) text(point - left - 1:point - left - 1) = '-'
    do k = 1, 17
      power = exponent - k
      if (power < -decimals) exit
      left = point - power - merge(1, 0, power >= 0)
      text(left:left) = digits(k:k)
    end do
  end function

  logical function is_negative_(value)
    real(real64), intent(in) :: value
    is_negative_ = sign(1.0_real64, value) < 0
  end function

  subroutine put_real_(value)
    real(real64), intent(in) :: value
    character(len=longest) :: text
    character :: letter
    integer :: width, decimals
    logical :: fits
    call next_field_(.false., letter, width, decimals)
    if (value /= value) call refuse_(place, 'an undefined number cannot be written')
    if (abs(value) >= 1d99 .or. (abs(value) > 0 .and. abs(value) < 1d-100)) &
      call refuse_(place, 'a number is out of a card''s range, E-99 to E+99')
    if (letter == 'E') then
      fits = e_field_(text, width, decimals, value)
    else
      fits = f_field_(text, width, decimals, value)
    end if
    if (.not. fits) then
      width = 14
      fits = e_field_(text, width, 8, value)
    end if
    call write_columns_(text(:width))
  end subroutine

  subroutine put_integer_(value)
    integer(int64), intent(in) :: value
    character(len=:), allocatable :: digits
    character :: letter
    integer :: width, decimals, room
    call next_field_(.true., letter, width, decimals)
    digits = text_(abs(defined_(place, value)))
    ! High-order digits that do not fit are lost. Only a negative number needs a column for its sign.
    room = width - merge(1, 0, value < 0)
    if (len(digits) > room) then
      digits = digits(len(digits) - room + 1:)
      do while (len(digits) > 1)
        if (digits(1:1) /= '0') exit
        digits = digits(2:)
      end do
    end if
    if (value < 0) digits = '-' // digits
    call write_columns_(repeat(' ', width - len(digits)) // digits)
  end subroutine
end module

// The table of IGES 5.3 chapter 4: every type and form, its name and its parameters. The language is that of layout.h.
// 306 (macro text) and implementor-defined types have no layout; theirs stay as the file has them.

#include <algorithm>
#include <iterator>

#include "formats/iges/records/layout.h"

namespace trimloop::iges {
namespace {

struct Row {
  int type, first_form, last_form;
  std::string_view name, text;
};

// clang-format off (one form a row)
constexpr Row rows[] = {
    {0, 0, 9999, "Null", ""},
    {100, 0, 0, "Circular Arc", "ZT:r X1:r Y1:r X2:r Y2:r X3:r Y3:r"},
    {102, 0, 0, "Composite Curve", "N:n N*(DE:p)"},
    {104, 0, 3, "Conic Arc", "A:r B:r C:r D:r E:r F:r ZT:r X1:r Y1:r X2:r Y2:r"},
    {106, 1, 3, "Copious Data",
     "IP:i N:n IP=1?(ZT:r N*(X:r Y:r)) IP=2?(N*(X:r Y:r Z:r)) IP=3?(N*(X:r Y:r Z:r I:r J:r K:r))"},
    {106, 11, 13, "Linear Path",
     "IP:i N:n IP=1?(ZT:r N*(X:r Y:r)) IP=2?(N*(X:r Y:r Z:r)) IP=3?(N*(X:r Y:r Z:r I:r J:r K:r))"},
    {106, 20, 20, "Centreline through Points",
     "IP:i N:n IP=1?(ZT:r N*(X:r Y:r)) IP=2?(N*(X:r Y:r Z:r)) IP=3?(N*(X:r Y:r Z:r I:r J:r K:r))"},
    {106, 21, 21, "Centreline through Circle Centres",
     "IP:i N:n IP=1?(ZT:r N*(X:r Y:r)) IP=2?(N*(X:r Y:r Z:r)) IP=3?(N*(X:r Y:r Z:r I:r J:r K:r))"},
    {106, 31, 38, "Section",
     "IP:i N:n IP=1?(ZT:r N*(X:r Y:r)) IP=2?(N*(X:r Y:r Z:r)) IP=3?(N*(X:r Y:r Z:r I:r J:r K:r))"},
    {106, 40, 40, "Witness Line",
     "IP:i N:n IP=1?(ZT:r N*(X:r Y:r)) IP=2?(N*(X:r Y:r Z:r)) IP=3?(N*(X:r Y:r Z:r I:r J:r K:r))"},
    {106, 63, 63, "Simple Closed Planar Curve",
     "IP:i N:n IP=1?(ZT:r N*(X:r Y:r)) IP=2?(N*(X:r Y:r Z:r)) IP=3?(N*(X:r Y:r Z:r I:r J:r K:r))"},
    {108, -1, 1, "Plane", "A:r B:r C:r D:r PTR:p=0 X:r=0 Y:r=0 Z:r=0 SIZE:r=0"},
    {110, 0, 2, "Line", "X1:r Y1:r Z1:r X2:r Y2:r Z2:r"},
    {112, 0, 0, "Parametric Spline Curve",
     "CTYPE:i H:i NDIM:i N:n N+1*(T:r) N*(AX:r BX:r CX:r DX:r AY:r BY:r CY:r DY:r AZ:r BZ:r CZ:r DZ:r) TPX0:r "
     "TPX1:r TPX2:r TPX3:r TPY0:r TPY1:r TPY2:r TPY3:r TPZ0:r TPZ1:r TPZ2:r TPZ3:r"},
    {114, 0, 0, "Parametric Spline Surface",
     "CTYPE:i PTYPE:i M:n N:n M+1*(TU:r) N+1*(TV:r) M+1*(N+1*(AX:r BX:r CX:r DX:r EX:r FX:r GX:r HX:r IX:r JX:r "
     "KX:r LX:r MX:r NX:r OX:r PX:r AY:r BY:r CY:r DY:r EY:r FY:r GY:r HY:r IY:r JY:r KY:r LY:r MY:r NY:r OY:r "
     "PY:r AZ:r BZ:r CZ:r DZ:r EZ:r FZ:r GZ:r HZ:r IZ:r JZ:r KZ:r LZ:r MZ:r NZ:r OZ:r PZ:r))"},
    {116, 0, 0, "Point", "X:r Y:r Z:r PTR:p=0"},
    {118, 0, 1, "Ruled Surface", "DE1:p DE2:p DIRFLG:l DEVFLG:l"},
    {120, 0, 0, "Surface of Revolution", "L:p C:p SA:r TA:r"},
    {122, 0, 0, "Tabulated Cylinder", "DE:p LX:r LY:r LZ:r"},
    {123, 0, 0, "Direction", "X:r Y:r Z:r"},
    {124, 0, 12, "Transformation Matrix", "R11:r R12:r R13:r T1:r R21:r R22:r R23:r T2:r R31:r R32:r R33:r T3:r"},
    {125, 0, 4, "Flash", "X:r Y:r D1:r=0 D2:r=0 ROT:r=0 DE:p=0"},
    {126, 0, 5, "Rational B-Spline Curve",
     "K:n M:n PROP1:l PROP2:l PROP3:l PROP4:l K+M+2*@-M(T:r) K+1*@0(W:r) K+1*@0(X:r Y:r Z:r) 2*@0(V:r) XNORM:r "
     "YNORM:r ZNORM:r"},
    {128, 0, 9, "Rational B-Spline Surface",
     "K1:n K2:n M1:n M2:n PROP1:l PROP2:l PROP3:l PROP4:l PROP5:l K1+M1+2*@-M1(S:r) K2+M2+2*@-M2(T:r) "
     "K2+1*~@0(K1+1*@0(W:r)) K2+1*~@0(K1+1*@0(X:r Y:r Z:r)) 2*@0(U:r) 2*@0(V:r)"},
    {130, 0, 0, "Offset Curve",
     "DE1:p FLAG:i DE2:p=0 NDIM:i=0 PTYPE:i=0 D1:r TD1:r D2:r TD2:r VX:r VY:r VZ:r TT1:r TT2:r"},
    {132, 0, 0, "Connect Point",
     "X:r Y:r Z:r PTR:p=0 TF:i=0 FF:i=0 CID:s PTTCID:p=0 CFN:s PTTCFN:p=0 CPID:i=0 FC:i=0 SF:i=0 PSFI:p=0"},
    {134, 0, 0, "Node", "X:r Y:r Z:r NDCSP:p=0"},
    {136, 0, 0, "Finite Element", "ITOP:i N:n N*(DE:p) ETYP:s"},
    {138, 0, 0, "Nodal Displacement and Rotation",
     "NC:n NC*(GNP:p) NN:n NN*(NID:i NP:p NC*(TX:r TY:r TZ:r RX:r RY:r RZ:r))"},
    {140, 0, 0, "Offset Surface", "NX:r NY:r NZ:r D:r DE:p"},
    {141, 0, 0, "Boundary", "TYPE:i PREF:i SPTR:p N:n N*(CRVPT:p SENSE:i K:n K*(PSCPT:p))"},
    {142, 0, 0, "Curve on a Parametric Surface", "CRTN:i SPTR:p BPTR:p CPTR:p PREF:i"},
    {143, 0, 0, "Bounded Surface", "TYPE:i SPTR:p N:n N*(BDPT:p)"},
    {144, 0, 0, "Trimmed Parametric Surface", "PTS:p N1:i N2:n PTO:p N2*(PTI:p)"},
    {146, 0, 34, "Nodal Results", "GNP:p SCN:i TIME:r NV:n NN:n NN*(NID:i NP:p NV*(V:r))"},
    {148, 0, 34, "Element Results",
     "GNP:p SCN:i TIME:r NV:i RRF:i NE:n NE*(EID:i EP:p ITOP:i NL:i DLF:i NRL:n NRL*(RDRL:i) NR:n NR*(V:r))"},
    {150, 0, 0, "Block", "LX:r LY:r LZ:r X1:r=0 Y1:r=0 Z1:r=0 I1:r=1 J1:r=0 K1:r=0 I2:r=0 J2:r=0 K2:r=1"},
    {152, 0, 0, "Right Angular Wedge",
     "LX:r LY:r LZ:r LTX:r X1:r=0 Y1:r=0 Z1:r=0 I1:r=1 J1:r=0 K1:r=0 I2:r=0 J2:r=0 K2:r=1"},
    {154, 0, 0, "Right Circular Cylinder", "H:r R:r X1:r=0 Y1:r=0 Z1:r=0 I1:r=0 J1:r=0 K1:r=1"},
    {156, 0, 0, "Right Circular Cone Frustum", "H:r R1:r R2:r=0 X1:r=0 Y1:r=0 Z1:r=0 I1:r=0 J1:r=0 K1:r=1"},
    {158, 0, 0, "Sphere", "R:r X1:r=0 Y1:r=0 Z1:r=0"},
    {160, 0, 0, "Torus", "R1:r R2:r X1:r=0 Y1:r=0 Z1:r=0 I1:r=0 J1:r=0 K1:r=1"},
    {162, 0, 1, "Solid of Revolution", "PTR:p F:r=1 X1:r=0 Y1:r=0 Z1:r=0 I1:r=0 J1:r=0 K1:r=1"},
    {164, 0, 0, "Solid of Linear Extrusion", "PTR:p L:r I1:r=0 J1:r=0 K1:r=1"},
    {168, 0, 0, "Ellipsoid", "LX:r LY:r LZ:r X1:r=0 Y1:r=0 Z1:r=0 I1:r=1 J1:r=0 K1:r=0 I2:r=0 J2:r=0 K2:r=1"},
    {180, 0, 1, "Boolean Tree", "N:n N*(PTR:P)"},
    {182, 0, 0, "Selected Component", "BTREE:p SELX:r SELY:r SELZ:r"},
    {184, 0, 1, "Solid Assembly", "N:n N*(PTR:p) N*(PTRM:p)"},
    {186, 0, 0, "Manifold Solid B-Rep Object", "SHELL:p SOF:l N:n N*(VOID:p VOF:l)"},
    {190, 0, 0, "Plane Surface", "DELOC:p DENRML:p"},
    {190, 1, 1, "Plane Surface", "DELOC:p DENRML:p DEREFD:p"},
    {192, 0, 0, "Right Circular Cylindrical Surface", "DELOC:p DEAXIS:p RADIUS:r"},
    {192, 1, 1, "Right Circular Cylindrical Surface", "DELOC:p DEAXIS:p RADIUS:r DEREFD:p"},
    {194, 0, 0, "Right Circular Conical Surface", "DELOC:p DEAXIS:p RADIUS:r SANGLE:r"},
    {194, 1, 1, "Right Circular Conical Surface", "DELOC:p DEAXIS:p RADIUS:r SANGLE:r DEREFD:p"},
    {196, 0, 0, "Spherical Surface", "DELOC:p RADIUS:r"},
    {196, 1, 1, "Spherical Surface", "DELOC:p RADIUS:r DEAXIS:p DEREFD:p"},
    {198, 0, 0, "Toroidal Surface", "DELOC:p DEAXIS:p MAJRAD:r MINRAD:r"},
    {198, 1, 1, "Toroidal Surface", "DELOC:p DEAXIS:p MAJRAD:r MINRAD:r DEREFD:p"},
    {202, 0, 0, "Angular Dimension", "DENOTE:p DEWIT1:p DEWIT2:p XT:r YT:r R:r DEARRW1:p DEARRW2:p"},
    {204, 0, 0, "Curve Dimension", "DENOTE:p DECURV1:p DECURV2:p DEARRW1:p DEARRW2:p DEWIT1:p DEWIT2:p"},
    {206, 0, 0, "Diameter Dimension", "DENOTE:p DEARRW1:p DEARRW2:p XT:r YT:r"},
    {208, 0, 0, "Flag Note", "XT:r YT:r ZT:r A:r DENOTE:p N:n N*(DEARRW:p)"},
    {210, 0, 0, "General Label", "DENOTE:p N:n N*(DEARRW:p)"},
    {212, 0, 105, "General Note",
     "NS:n NS*(NC:i WT:r HT:r FC:P=1 SL:r=1.5707963267948966 A:r=0 M:i=0 VH:i=0 XS:r YS:r ZS:r TEXT:s)"},
    {213, 0, 0, "New General Note",
     "WT:r HT:r JC:i XA:r YA:r ZA:r AA:r XB:r YB:r ZB:r NIS:r NS:n NS*(CF:i CW:r CH:r ICS:r ILS:r FS:i CA:r CCS:s "
     "NC:i BW:r BH:r FC:P=1 SL:r=1.5707963267948966 A:r=0 M:i=0 VH:i=0 XS:r YS:r ZS:r TEXT:s)"},
    {214, 1, 12, "Leader", "N:n AD1:r AD2:r ZT:r XH:r YH:r N*(X:r Y:r)"},
    {216, 0, 2, "Linear Dimension", "DENOTE:p DEARRW1:p DEARRW2:p DEWIT1:p=0 DEWIT2:p=0"},
    {218, 0, 0, "Ordinate Dimension", "DENOTE:p DEORD:p"},
    {218, 1, 1, "Ordinate Dimension", "DENOTE:p DEORD:p DESUPP:p"},
    {220, 0, 0, "Point Dimension", "DENOTE:p DEARRW:p DEGEOM:p=0"},
    {222, 0, 0, "Radius Dimension", "DENOTE:p DEARRW1:p XT:r YT:r"},
    {222, 1, 1, "Radius Dimension", "DENOTE:p DEARRW1:p XT:r YT:r DEARRW2:p=0"},
    {228, 0, 3, "General Symbol", "DENOTE:p N:n N*(DEGEOM:p) L:n L*(DEARRW:p)"},
    {228, 5001, 9999, "General Symbol", "DENOTE:p N:n N*(DEGEOM:p) L:n L*(DEARRW:p)"},
    {230, 0, 1, "Sectioned Area",
     "BNDP:p PATRN:i XT:r=0 YT:r=0 ZT:r=0 DIST:r=0 ANGLE:r=0.7853981633974483 N:n N*(ISLNDP:p)"},
    {302, 0, 9999, "Associativity Definition", "K:n K*(BP:i OR:i N:n N*(IT:i))"},
    {304, 1, 1, "Line Font Definition", "M:i L1:p L2:r L3:r=1"},
    {304, 2, 2, "Line Font Definition", "M:n M*(L:r) B:s"},
    {308, 0, 0, "Subfigure Definition", "DEPTH:i NAME:s N:n N*(DE:p)"},
    {310, 0, 0, "Text Font Definition",
     "FC:i FNAME:s SF:P=0 SCALE:i N:n N*(AC:i NX:i NY:i NM:n NM*(PF:i X:i Y:i))"},
    {312, 0, 1, "Text Display Template",
     "CBW:r CBH:r FC:P=1 SL:r=1.5707963267948966 A:r=0 M:i=0 VH:i=0 XS:r YS:r ZS:r"},
    {314, 0, 0, "Color Definition", "CC1:r CC2:r CC3:r CNAME:s="},
    {316, 0, 0, "Units Data", "NP:n NP*(TYP:s VAL:s SF:r)"},
    {320, 0, 0, "Network Subfigure Definition",
     "DEPTH:i NAME:s N:n N*(DE:p) TF:i=0 PRD:s DPTR:p=0 NC:n=0 NC*(CPTR:p)"},
    {322, 0, 0, "Attribute Table Definition", "NAME:s ALT:i NA:n NA*(AT:i AVDT:i AVC:n)"},
    {322, 1, 1, "Attribute Table Definition", "NAME:s ALT:i NA:n NA*(AT:i AVDT:i AVC:n AVC*(AV:t))"},
    {322, 2, 2, "Attribute Table Definition", "NAME:s ALT:i NA:n NA*(AT:i AVDT:i AVC:n AVC*(AV:t AVP:p))"},
    {402, 1, 1, "Group", "N:n N*(DE:p)"},
    {402, 3, 3, "Views Visible", "NV:n NE:n NV*(VIEW:p) NE*(DE:p)"},
    {402, 4, 4, "Views Visible, Color, Line Weight", "NV:n NE:n NV*(VIEW:p LF:i LFDEF:p CN:P LW:i) NE*(DE:p)"},
    {402, 5, 5, "Entity Label Display", "N:n N*(VIEW:p XT:r YT:r ZT:r LEADER:p LEVEL:i DE:p)"},
    {402, 6, 6, "View List", "NV:i N:n VIEW:p N*(DE:p)"},
    {402, 7, 7, "Group without Back Pointers", "N:n N*(DE:p)"},
    {402, 9, 9, "Single Parent", "NP:i NC:n DEP:p NC*(DE:p)"},
    {402, 12, 12, "External Reference File Index", "N:n N*(NAME:s DE:p)"},
    {402, 13, 13, "Dimensioned Geometry", "ND:i NG:n DDE:p NG*(GDE:p)"},
    {402, 14, 14, "Ordered Group with Back Pointers", "N:n N*(DE:p)"},
    {402, 15, 15, "Ordered Group without Back Pointers", "N:n N*(DE:p)"},
    {402, 16, 16, "Planar", "NT:i N:n TRANS:p N*(DE:p)"},
    {402, 18, 18, "Flow",
     "NCF:i=2 NF:n NC:n NJ:n NN:n NT:n NP:n TF:i=0 FF:i=0 NF*(SPTR:p) NC*(CPTR:p) NJ*(JPTR:p) NN*(NAME:s) "
     "NT*(GPTR:p) NP*(CFPTR:p)"},
    {402, 19, 19, "Segmented Views Visible", "NB:n NB*(VIEW:p BP:r DF:i CN:P LF:P LW:i)"},
    {402, 20, 20, "Piping Flow",
     "NCF:i=1 NF:n NC:n NJ:n NN:n NT:n NP:n TF:i=0 NF*(SPTR:p) NC*(CPTR:p) NJ*(JPTR:p) NN*(NAME:s) NT*(GPTR:p) "
     "NP*(CFPTR:p)"},
    {402, 21, 21, "Dimensioned Geometry", "ND:i NG:n DDE:p DOF:i AVAL:r NG*(GDE:p DLF:i X:r Y:r Z:r)"},
    {404, 0, 0, "Drawing", "NV:n NV*(VPTR:p XORG:r YORG:r) M:n M*(DPTR:p)"},
    {404, 1, 1, "Drawing", "NV:n NV*(VPTR:p XORG:r YORG:r ANGLE:r) M:n M*(DPTR:p)"},
    {406, 1, 1, "Definition Levels", "NP:n NP*[NP*(L:i)]"},
    {406, 2, 2, "Region Restriction", "NP:n NP*[EVR:i ECPR:i ECRR:i]"},
    {406, 3, 3, "Level Function", "NP:n NP*[FC:i FD:s]"},
    {406, 4, 4, "Region Fill", "NP:n NP*[]"},
    {406, 5, 5, "Line Widening", "NP:n NP*[WM:r CF:i EF:i JF:i E:r]"},
    {406, 6, 6, "Drilled Hole", "NP:n NP*[DD:r FD:r PF:i LL:i HL:i]"},
    {406, 7, 7, "Reference Designator", "NP:n NP*[RD:s]"},
    {406, 8, 8, "Pin Number", "NP:n NP*[PN:s]"},
    {406, 9, 9, "Part Number", "NP:n NP*[GPN:s MPN:s VPN:s IPN:s]"},
    {406, 10, 10, "Hierarchy", "NP:n NP*[LF:i VU:i LAB:i BL:i LW:i CO:i]"},
    {406, 11, 11, "Tabular Data", "NP:n NP*[PTYPE:i ND:n NI:n NI*(TYPI:i) NI*(NVALI:n)]"},
    {406, 12, 12, "External Reference File List", "NP:n NP*[NP*(NAME:s)]"},
    {406, 13, 13, "Nominal Size", "NP:n NP*[SZ:r NM:s SPEC:s]"},
    {406, 14, 14, "Flow Line Specification", "NP:n NP*[NP*(FLS:s)]"},
    {406, 15, 15, "Name", "NP:n NP*[NAME:s]"},
    {406, 16, 16, "Drawing Size", "NP:n NP*[XS:r YS:r]"},
    {406, 17, 17, "Drawing Units", "NP:n NP*[FLAG:i UNIT:s]"},
    {406, 18, 18, "Intercharacter Spacing", "NP:n NP*[ISPACE:r]"},
    {406, 19, 19, "Line Font", "NP:n NP*[LFPC:i]"},
    {406, 20, 20, "Highlight", "NP:n NP*[HF:i]"},
    {406, 21, 21, "Pick", "NP:n NP*[PF:i]"},
    {406, 22, 22, "Uniform Rectangular Grid", "NP:n NP*[FD:i LP:i WU:i PX:r PY:r DX:r DY:r NX:i NY:i]"},
    {406, 23, 23, "Associativity Group Type", "NP:n NP*[TYPE:i NAME:s]"},
    {406, 24, 24, "Level to LEP Layer Map", "NP:n NP*[ND:n ND*(EL:i NLN:s PLN:i ELN:s)]"},
    {406, 25, 25, "LEP Artwork Stackup", "NP:n NP*[ID:s NL:n NL*(L:i)]"},
    {406, 26, 26, "LEP Drilled Hole", "NP:n NP*[DD:r FD:r FC:i]"},
    {406, 27, 27, "Generic Data", "NP:n NP*[NAME:s N:n N*(TYPE:i VAL:t)]"},
    {406, 28, 28, "Dimension Units", "NP:n NP*[SPOS:i UI:i CS:i FS:s FF:i PREC:i]"},
    {406, 29, 29, "Dimension Tolerance", "NP:n NP*[STF:i TT:i TPF:i UT:r LT:r SSF:l FF:i PREC:i]"},
    {406, 30, 30, "Dimension Display Data",
     "NP:n NP*[DTYP:i LP:i CS:i LS:s DS:i WLA:r TA:i TL:i TP:i AHO:i IV:r N:n N*(SN:i IS:i IE:i)]"},
    {406, 31, 31, "Basic Dimension", "NP:n NP*[LLX:r LLY:r LRX:r LRY:r URX:r URY:r ULX:r ULY:r]"},
    {406, 32, 32, "Drawing Sheet Approval", "NP:n NP*[]"},
    {406, 33, 33, "Drawing Sheet ID", "NP:n NP*[]"},
    {406, 34, 34, "Underscore", "NP:n NP*[]"},
    {406, 35, 35, "Overscore", "NP:n NP*[]"},
    {406, 36, 36, "Closure", "NP:n NP*[]"},
    {406, 5001, 9999, "Implementor-Defined Property", "NP:n NP*[]"},
    {408, 0, 0, "Singular Subfigure Instance", "DE:p X:r Y:r Z:r S:r=1"},
    {410, 0, 0, "View", "VNO:i SCALE:r=1 XVMINP:p=0 YVMAXP:p=0 XVMAXP:p=0 YVMINP:p=0 ZVMINP:p=0 ZVMAXP:p=0"},
    {410, 1, 1, "Perspective View",
     "VNO:i SCALE:r=1 VPNX:r VPNY:r VPNZ:r VRPX:r VRPY:r VRPZ:r CPX:r CPY:r CPZ:r VUX:r VUY:r VUZ:r VPD:r UMIN:r "
     "UMAX:r VMIN:r VMAX:r DCI:i=0 BPD:r=0 FPD:r=0"},
    {412, 0, 0, "Rectangular Array Subfigure Instance",
     "DE:p S:r=1 X:r Y:r Z:r NC:i NR:i DX:r DY:r AX:r=0 LC:n=0 DDF:i=0 LC*(NUM:i)"},
    {414, 0, 0, "Circular Array Subfigure Instance",
     "DE:p NX:i X:r Y:r Z:r R:r AS:r DA:r LC:n=0 DDF:i=0 LC*(NUM:i)"},
    {416, 0, 0, "External Reference", "FNAME:s DNAME:s"},
    {416, 1, 1, "External Reference", "FNAME:s"},
    {416, 2, 2, "External Reference", "FNAME:s DNAME:s"},
    {416, 3, 3, "External Reference", "DNAME:s"},
    {416, 4, 4, "External Reference", "DNAME:s LNAME:s"},
    {418, 0, 0, "Nodal Load/Constraint", "NC:n TYPE:i NP:p NC*(TDP:p)"},
    {420, 0, 0, "Network Subfigure Instance",
     "DE:p X:r Y:r Z:r XS:r=1 YS:r= ZS:r= TF:i=0 PRD:s DPTR:p=0 NC:n=0 NC*(CPTR:p)"},
    {422, 0, 0, "Attribute Table Instance", "ATTRS*(AV:t)"},
    {422, 1, 1, "Attribute Table Instance", "NR:n NR*(ATTRS*(AV:t))"},
    {430, 0, 1, "Solid Instance", "DE:p"},
    {502, 1, 1, "Vertex List", "N:n N*(X:r Y:r Z:r)"},
    {504, 1, 1, "Edge List", "N:n N*(CURV:p SVP:p SV:i TVP:p TV:i)"},
    {508, 0, 1, "Loop", "N:n N*(TYPE:i EDGE:p NDX:i OF:l K:n K*(ISOP:l CURV:p))"},
    {510, 1, 1, "Face", "SURF:p N:n OF:l N*(LOOP:p)"},
    {514, 1, 2, "Shell", "N:n N*(FACE:p OF:l)"},
};
// clang-format on

std::vector<Layout> compiled() {
  std::vector<Layout> out;
  out.reserve(std::size(rows));
  for (const Row& row : rows)
    out.push_back({row.type, row.first_form, row.last_form, row.name, row.text, compile_layout(row.text)});
  return out;
}

}  // namespace

std::span<const Layout> layouts() {
  static const std::vector<Layout> table = compiled();
  return table;
}

const Layout* find_layout(int type, int form) {
  const std::span<const Layout> all = layouts();
  const auto first =
      std::lower_bound(all.begin(), all.end(), type, [](const Layout& l, int wanted) { return l.type < wanted; });
  auto row = first;
  for (; row != all.end() && row->type == type; ++row)
    if (form >= row->first_form && form <= row->last_form) return &*row;
  // A form that the standard does not have: as the type's first one, where all forms are much alike.
  if (first == row || type == 402) return nullptr;
  return type == 406 ? &*std::prev(row) : &*first;
}

}  // namespace trimloop::iges

//! Words of the entries of geometry tables, in the order of the fields of their cards.
//!
//! `i` integer, `z` integer that is blank for 0, `r` real, `t` real that is blank unless positive, `d` real of 64 bits, `m` angle or system,
//! `x` word that has no field, `_` field that has no word; a capital is a field with this letter.
//! NX Nastran DMAP Programmer's Guide, *Data blocks*, GEOM1, GEOM2, GEOM4, EPT and MPT.

/// Kind, card and possible layouts.
type Layouts = ([i64; 3], &'static str, &'static [&'static str]);

pub(super) const LAYOUTS: &[Layouts] = &[
    ([4501, 45, 1], "GRID", &["izrrrzxx", "izdddzxx"]),
    ([1701, 17, 6], "CORD1C", &["ixxiii"]),
    ([1801, 18, 5], "CORD1R", &["ixxiii"]),
    ([1901, 19, 7], "CORD1S", &["ixxiii"]),
    ([2001, 20, 9], "CORD2C", &["ixxzrrrrrrrrr", "ixxzddddddddd"]),
    ([2101, 21, 8], "CORD2R", &["ixxzrrrrrrrrr", "ixxzddddddddd"]),
    ([2201, 22, 10], "CORD2S", &["ixxzrrrrrrrrr", "ixxzddddddddd"]),
    ([5508, 55, 217], "CTETRA", &["iizzzzzzzzzz"]),
    ([4108, 41, 280], "CPENTA", &["iizzzzzzzzzzzzzzz"]),
    ([7308, 73, 253], "CHEXA", &["iizzzzzzzzzzzzzzzzzzzz"]),
    ([17200, 172, 1000], "CPYRAM", &["iizzzzzzzzzzzzzx", "iizzzzzzzzzzzzz"]),
    ([5959, 59, 282], "CTRIA3", &["iizzzmr__xxzttt", "iizzzmr__xxztttx"]),
    ([9200, 92, 385], "CTRIAR", &["iizzzmr__xxzttt", "iizzzmr__xxztttx"]),
    ([2958, 51, 177], "CQUAD4", &["iizzzzmr_xztttt", "iizzzzmr_xzttttx"]),
    ([15401, 154, 9954], "CQUADR", &["iizzzzmr_xztttt"]),
    ([8009, 80, 367], "CQUADR", &["iizzzzmr_xztttt", "iizzzzmr_xzttttx"]),
    ([4801, 48, 327], "CTRIA6", &["iizzzzzzmrtttz", "iizzzzzzmrtttzx", "iizzzzzzmrttt"]),
    ([4701, 47, 326], "CQUAD8", &["iizzzzzzzzttttmrz", "iizzzzzzzzttttmrzx", "iizzzzzzzzttttmr"]),
    ([9108, 91, 507], "CQUAD", &["iizzzzzzzzx"]),
    ([3001, 30, 48], "CROD", &["iiii"]),
    ([3701, 37, 49], "CTUBE", &["iiii"]),
    ([1601, 16, 47], "CONROD", &["iiiirrrr", "iiiirrr"]),
    ([1501, 15, 64], "CONM2", &["iiirrrr_rrrrrr", "iiirrrr_rrrrrrx"]),
    ([6601, 66, 292], "RBAR", &["iiizzzz", "iiizzzzx", "iiizzzzxx"]),
    ([52, 20, 181], "PBAR", &["iirrrrr_xrrrrrrrrttr"]),
    ([902, 9, 29], "PROD", &["iirrrr"]),
    ([1602, 16, 30], "PTUBE", &["iirrr", "iirrrx"]),
    ([2302, 23, 283], "PSHELL", &["izrzrzrrrrz"]),
    ([2402, 24, 281], "PSOLID", &["iixxxxx"]),
    ([302, 3, 46], "PELAS", &["irrr"]),
    ([202, 2, 45], "PDAMP", &["ir"]),
    (
        [1402, 14, 37],
        "PBUSH",
        &[
            "iKrrrrrr_Brrrrrrxxxxxxxxxx",
            "iKrrrrrr_Brrrrrrxxxxxxxxxxx",
            "iKrrrrrr_Brrrrrrxxxxxxxxxxxxxx",
            "iKrrrrrr_Brrrrrrxxxxx",
        ],
    ),
    ([103, 1, 77], "MAT1", &["irrrrrrrrrrz", "irrrrrrrrrr"]),
    ([2503, 25, 288], "MAT8", &["irrrrrrrrrrrrrrrrrr", "irrrrrrrrrrrrrrrrrrxx"]),
];

/// Kind, card and words of an entry, 0 where they vary, of what decks do not carry either.
pub(super) const COUNTED: &[([i64; 3], &str, usize)] = &[
    ([7409, 74, 9991], "CHEXPR", 22),
    ([7509, 75, 9992], "CPENPR", 17),
    ([7609, 76, 9993], "CTETPR", 12),
    ([7708, 77, 9944], "CHEXAL", 0),
    ([7108, 71, 9943], "CPENTAL", 0),
    ([6108, 61, 107], "CTRIAX6", 11),
    ([4301, 43, 28], "GENEL", 0),
    ([3101, 31, 61], "CSHEAR", 6),
    ([3901, 39, 50], "CVISC", 4),
    ([1908, 19, 104], "CGAP", 9),
    ([1401, 14, 63], "CONM1", 24),
    ([801, 8, 75], "CELAS3", 4),
    ([901, 9, 76], "CELAS4", 4),
    ([401, 4, 71], "CDAMP3", 4),
    ([501, 5, 72], "CDAMP4", 4),
    ([1001, 10, 65], "CMASS1", 6),
    ([1101, 11, 66], "CMASS2", 6),
    ([1201, 12, 67], "CMASS3", 4),
    ([1301, 13, 68], "CMASS4", 4),
    ([4601, 46, 298], "CBEND", 0),
    ([15418, 154, 610], "CBEAM3", 0),
    ([2315, 23, 146], "CCONEAX", 4),
    ([9801, 98, 506], "CFAST", 0),
    ([11701, 117, 559], "CWELD", 0),
    ([5501, 55, 16], "SPC", 0),
    ([5481, 58, 12], "SPC1", 0),
    ([5491, 59, 13], "SPCADD", 0),
    ([2502, 25, 248], "PBEND", 0),
    ([1802, 18, 31], "PVISC", 3),
    ([1302, 13, 34], "PELAST", 4),
    ([6801, 68, 294], "RBE1", 0),
    ([6501, 65, 291], "RROD", 0),
    ([6701, 67, 293], "RTRPLT", 0),
    ([2102, 21, 121], "PGAP", 11),
    ([1002, 10, 42], "PSHEAR", 6),
    ([203, 2, 78], "MAT2", 17),
    ([2603, 26, 300], "MAT9", 0),
    ([2801, 28, 365], "MAT10", 5),
];

/// First words of the kinds of records that say nothing of the body: points and lines to plot, supports, tables of the solver.
pub(super) const ANALYSIS: [i64; 12] = [5551, 5201, 2010, 3003, 3103, 5110, 5561, 10100, 503, 1427, 927, 827];
